// SPDX-License-Identifier: Apache-2.0
// Reads the stored numbers of a volume file in sequence: bytes of some type and order, or text.
#pragma once

#include <bit>
#include <span>
#include <vector>

#include "scene/volume/byte_reader.hpp"

namespace fastsplat::volume {

enum class Component { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };
std::size_t size_of(Component component);

class StoredValues {
 public:
  /// Starts `skip` unpacked bytes after `offset`. Throws UserError (Input) if the data ends before.
  StoredValues(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t skip, Packing packing,
               Component component, std::endian order);

  /// The next numbers, at least one and at most `most`; empty at the end of the data. Text that is not a number of the
  /// type is a UserError (Input).
  std::span<const double> next(std::uint64_t most);
  /// Bytes at the end that do not make up a number.
  std::size_t rest() const { return rest_; }
  void verify_rest() { reader_.verify_rest(); }

 private:
  std::span<const double> next_bytes(std::uint64_t most);
  std::span<const double> next_words(std::uint64_t most);
  double number_from(std::string_view word) const;

  std::filesystem::path path_;
  ByteReader reader_;
  Packing packing_;
  Component component_;
  bool swap_;
  std::vector<unsigned char> chunk_;
  std::vector<double> values_;
  std::size_t at_ = 0, end_ = 0;  // text: the unread part of the chunk
  std::size_t rest_ = 0;
  std::uint64_t count_ = 0;  // numbers so far
};

}  // namespace fastsplat::volume
