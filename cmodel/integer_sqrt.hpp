// floor(sqrt(v)) of a word, digit by digit: one bit of the root a step, with subtractions and shifts only.
#pragma once

#include <bit>
#include <cstdint>

namespace fastsplat::cmodel {

/// The largest s with s * s <= v.
constexpr std::uint64_t integer_sqrt(std::uint64_t v) {
  std::uint64_t root = 0, rest = v;
  // The highest even bit that v reaches.
  for (int at = v == 0 ? -2 : (std::bit_width(v) - 1) / 2 * 2; at >= 0; at -= 2) {
    const std::uint64_t bit = std::uint64_t{1} << at;
    const bool one = rest >= root + bit;
    if (one) rest -= root + bit;
    root = (root >> 1) + (one ? bit : 0);
  }
  return root;
}

}  // namespace fastsplat::cmodel
