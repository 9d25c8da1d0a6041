// SPDX-License-Identifier: Apache-2.0
// CRC-32 (IEEE 802.3, as zlib's crc32) of a stream's beats, eight bytes per step by table.
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/stream/beat.hpp"

namespace fastsplat::cmodel {

class Crc32 {
 public:
  /// Adds the beat's bytes, words little-endian.
  void add(const Beat& beat) {
    for (std::size_t i = 0; i < beat.size(); i += 2) {
      const std::uint32_t low = state_ ^ beat[i], high = beat[i + 1];
      state_ = kTables[7][low & 0xff] ^ kTables[6][low >> 8 & 0xff] ^ kTables[5][low >> 16 & 0xff] ^
               kTables[4][low >> 24] ^ kTables[3][high & 0xff] ^ kTables[2][high >> 8 & 0xff] ^
               kTables[1][high >> 16 & 0xff] ^ kTables[0][high >> 24];
    }
  }
  std::uint32_t value() const { return ~state_; }

 private:
  using Tables = std::array<std::array<std::uint32_t, 256>, 8>;
  /// kTables[n][b]: the remainder of byte b followed by n zero bytes.
  static consteval Tables make() {
    Tables tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t remainder = byte;
      for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xEDB88320U : 0);
      tables[0][byte] = remainder;
    }
    for (std::size_t n = 1; n < 8; ++n)
      for (std::size_t byte = 0; byte < 256; ++byte)
        tables[n][byte] = tables[n - 1][byte] >> 8 ^ tables[0][tables[n - 1][byte] & 0xff];
    return tables;
  }
  static const Tables kTables;

  std::uint32_t state_ = ~std::uint32_t{0};
};

inline constexpr Crc32::Tables Crc32::kTables = Crc32::make();

}  // namespace fastsplat::cmodel
