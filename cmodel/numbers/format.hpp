// SPDX-License-Identifier: Apache-2.0
// Fixed-point formats (docs/numerics.md, section 1).
#pragma once

#include <cstdint>

namespace fastsplat::cmodel {

/// The range of a quantity's words; value = word / 2^frac_bits.
struct Format {
  std::int64_t min = 0;
  std::int64_t max = 0;
  int frac_bits = 0;
  int word_bits = 0;  ///< 0: the range is not a power of two, so the word cannot wrap
};

/// U i.f
constexpr Format unsigned_format(int int_bits, int frac_bits) {
  return {0, (std::int64_t{1} << (int_bits + frac_bits)) - 1, frac_bits, int_bits + frac_bits};
}

/// S i.f, int_bits include the sign
constexpr Format signed_format(int int_bits, int frac_bits) {
  const std::int64_t half = std::int64_t{1} << (int_bits + frac_bits - 1);
  return {-half, half - 1, frac_bits, int_bits + frac_bits};
}

/// One.f: the unit interval, both ends included
constexpr Format unit_format(int frac_bits) { return {0, std::int64_t{1} << frac_bits, frac_bits, 0}; }

}  // namespace fastsplat::cmodel
