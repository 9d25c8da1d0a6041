// SPDX-License-Identifier: Apache-2.0
// SHA-256 (FIPS 180-4), for contents that other programs check: a browser, `sha256sum`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fastsplat {

/// Hash of bytes that arrive in pieces.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// 64 lower-case hex digits; nothing may be added after it.
  std::string text();

 private:
  void block(const unsigned char* bytes);

  std::array<std::uint32_t, 8> state_{0x6a09e667U, 0xbb67ae85U, 0x3c6ef372U, 0xa54ff53aU,
                                      0x510e527fU, 0x9b05688cU, 0x1f83d9abU, 0x5be0cd19U};
  std::array<unsigned char, 64> pending_{};
  std::size_t pending_bytes_ = 0;
  std::uint64_t bytes_ = 0;
};

/// Hash of the whole text.
std::string sha256(std::string_view bytes);

}  // namespace fastsplat
