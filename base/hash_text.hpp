// SPDX-License-Identifier: Apache-2.0
// A 64-bit hash as text, in the form used wherever one is printed or stored.
#pragma once

#include <cstdint>
#include <string>

namespace fastsplat {

/// 16 lower-case hex digits.
inline std::string hash_text(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t digit = 16; digit-- > 0; hash >>= 4) text[digit] = "0123456789abcdef"[hash & 15];
  return text;
}

}  // namespace fastsplat
