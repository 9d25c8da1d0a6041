// The one function that loses bits (docs/numerics.md, section 1). Everything else in the device is exact.
#pragma once

#include <cassert>
#include <cstdint>

#include "cmodel/format.hpp"

namespace fastsplat::cmodel {

enum class Rounding {
  TRN,       ///< towards minus infinity
  RND,       ///< nearest, halves up
  RND_CONV,  ///< nearest, halves to even
};

enum class Overflow {
  WRAP,  ///< modulo the word
  SAT,   ///< the nearer end of the range
};

struct Narrowed {
  std::int64_t word = 0;
  bool inexact = false;   ///< a 1 bit was dropped
  bool overflow = false;  ///< the rounded value lay outside the format
};

/// `value` has `from_frac` fraction bits. |value| < 2^62 and the result before overflow handling fits 63 bits.
template <Rounding R, Overflow O>
constexpr Narrowed narrow(std::int64_t value, int from_frac, const Format& to) {
  const int shift = from_frac - to.frac_bits;
  Narrowed out;
  if (shift <= 0) {
    out.word = value * (std::int64_t{1} << -shift);
  } else {
    const std::int64_t dropped = value & ((std::int64_t{1} << shift) - 1);
    const std::int64_t half = std::int64_t{1} << (shift - 1);
    out.inexact = dropped != 0;
    out.word = value >> shift;
    if constexpr (R == Rounding::RND) {
      out.word += dropped >= half ? 1 : 0;
    } else if constexpr (R == Rounding::RND_CONV) {
      out.word += (dropped > half || (dropped == half && (out.word & 1) != 0)) ? 1 : 0;
    }
  }
  if (out.word < to.min || out.word > to.max) {
    out.overflow = true;
    if constexpr (O == Overflow::SAT) {
      out.word = out.word < to.min ? to.min : to.max;
    } else {
      assert(to.word_bits > 0 && "a unit-interval format cannot wrap");
      const std::int64_t modulus = std::int64_t{1} << to.word_bits;
      out.word &= modulus - 1;
      if (out.word > to.max) out.word -= modulus;
    }
  }
  return out;
}

}  // namespace fastsplat::cmodel
