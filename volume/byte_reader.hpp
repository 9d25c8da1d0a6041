// Sequential bytes of a file, plain or gzip, with every failure told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace fastsplat::volume {

enum class Packing { Plain, Gzip };

/// Gzip when the file starts with gzip's two magic bytes.
Packing packing_of(const std::filesystem::path& path);

class ByteReader {
 public:
  /// Starts at byte `offset` of the file as it is on disk.
  ByteReader(const std::filesystem::path& path, std::uint64_t offset, Packing packing);
  ~ByteReader();

  /// Fills `out` with up to `size` bytes; fewer only at the end of the data. Corrupt or truncated gzip data is a
  /// UserError (Input).
  std::size_t read(void* out, std::size_t size);
  /// Reads to the end so that gzip's checksum is verified; gives up quietly after a few MiB of surplus data.
  void verify_rest();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// `data` as one gzip member.
void write_gzip(std::ostream& out, const void* data, std::size_t size);

}  // namespace fastsplat::volume
