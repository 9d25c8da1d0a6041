// SPDX-License-Identifier: Apache-2.0
#include "base/images/tiff_declared.hpp"

#include <cstdint>

namespace fastsplat::images {
namespace {

/// Reads numbers in the file's byte order; 0 beyond its end.
class Numbers {
 public:
  explicit Numbers(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  bool little() const { return !bytes_.empty() && bytes_[0] == 'I'; }
  std::uint64_t at(std::uint64_t place, std::uint64_t size) const {
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::uint64_t byte = place + (little() ? size - 1 - i : i);
      value = value << 8 | (byte < bytes_.size() ? bytes_[byte] : 0);
    }
    return value;
  }

 private:
  std::span<const unsigned char> bytes_;
};

const char* name_of(std::uint64_t tag) {
  switch (tag) {
    case 291:
      return "GrayResponseCurve";
    case 301:
      return "TransferFunction";
    case 318:
      return "WhitePoint";
    case 319:
      return "PrimaryChromaticities";
    default:
      return "";
  }
}

}  // namespace

std::string tiff_unfollowed(std::span<const unsigned char> bytes) {
  const Numbers numbers(bytes);
  const bool big = numbers.at(2, 2) == 43;  // BigTIFF: eight-byte offsets
  const std::uint64_t directory = big ? numbers.at(8, 8) : numbers.at(4, 4), count_size = big ? 8 : 2,
                      entry_size = big ? 20 : 12;
  if (directory > bytes.size()) return {};
  const std::uint64_t count = numbers.at(directory, count_size);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t entry = directory + count_size + i * entry_size;
    if (entry + entry_size > bytes.size()) return {};
    if (const std::string name = name_of(numbers.at(entry, 2)); !name.empty()) return name;
  }
  return {};
}

}  // namespace fastsplat::images
