// SPDX-License-Identifier: Apache-2.0
// Sequential bytes of a file: plain, compressed or in hexadecimal digits. Every failure is reported.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>

namespace fastsplat::volume {

/// The encoding of the voxels on disk. Gzip and Zlib: either is accepted for the other. Text: decimal numbers between
/// blanks, which voxel_data parses.
enum class Packing { Plain, Gzip, Zlib, Bzip2, Hex, Text };

/// Gzip if the file starts with gzip's two magic bytes, else Plain.
Packing packing_of(const std::filesystem::path& path);

/// Offset of the first byte after `lines` line ends, counted from `offset`. Throws UserError (Input) if there are
/// fewer.
std::uint64_t offset_after_lines(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t lines);

/// Number of unpacked bytes of the file from `offset` on. Reads all of a packed file.
std::uint64_t unpacked_size(const std::filesystem::path& path, std::uint64_t offset, Packing packing);

class ByteReader {
 public:
  /// Starts at byte `offset` of the file as it is on disk. Text is read as it is.
  ByteReader(const std::filesystem::path& path, std::uint64_t offset, Packing packing);
  ~ByteReader();

  /// Fills `out` with up to `size` bytes; fewer only at the end of the data. Corrupt or truncated compressed data
  /// and invalid hexadecimal digits are a UserError (Input).
  std::size_t read(void* out, std::size_t size);
  /// Reads to the end so that a checksum is verified; gives up quietly after a few MiB of surplus data.
  void verify_rest();

  /// One way to unpack (byte_reader.cpp).
  class Unpacker;

 private:
  std::unique_ptr<Unpacker> unpacker_;
  Packing packing_;
};

/// `data` as one gzip member, or as one zlib stream.
void write_gzip(std::ostream& out, const void* data, std::size_t size);
void write_zlib(std::ostream& out, const void* data, std::size_t size);

}  // namespace fastsplat::volume
