// SPDX-License-Identifier: Apache-2.0
// Narrowing, the one operation that loses bits (N-1-2 to N-1-5). Everything else in the device is exact.
#pragma once

#include <cassert>
#include <cstdint>

#include "cmodel/numbers/format.hpp"

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

/// A prepared narrowing: what depends on rounding and formats is computed once.
class Narrowing {
 public:
  constexpr Narrowing(Rounding rounding, Overflow overflow, int from_frac, const Format& to)
      : rounding_(rounding), overflow_(overflow), from_frac_(from_frac), to_(to) {
    const int shift = from_frac - to.frac_bits;
    if (shift <= 0) {
      grown_bits_ = -shift;
      return;
    }
    dropped_bits_ = shift;
    const std::int64_t half = std::int64_t{1} << (shift - 1);
    even_ = rounding == Rounding::RND_CONV ? 1 : 0;
    bias_ = rounding == Rounding::TRN ? 0 : half - even_;
  }

  /// `value` has from_frac() fraction bits and |value| < 2^62. Unless it wraps, the rounded result must fit 63 bits.
  constexpr Narrowed operator()(std::int64_t value) const {
    Narrowed out;
    if (dropped_bits_ == 0) {
      out.word = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << grown_bits_);
    } else {
      // RND_CONV: half - 1, and one more if the word would be odd. Only then does a tie round up.
      out.word = (value + bias_ + ((value >> dropped_bits_) & even_)) >> dropped_bits_;
      out.inexact = dropped(value) != 0;
    }
    return fitted(out);
  }
  /// The same for a value that already has the word's fraction bits: only checks its range.
  constexpr Narrowed of_word(std::int64_t value) const { return fitted({.word = value}); }

  constexpr Rounding rounding() const { return rounding_; }
  constexpr int from_frac() const { return from_frac_; }
  constexpr const Format& to() const { return to_; }
  constexpr int dropped_bits() const { return dropped_bits_; }  ///< 0 where no bit is lost
  /// The bits of `value` that are dropped.
  constexpr std::int64_t dropped(std::int64_t value) const { return value & ((std::int64_t{1} << dropped_bits_) - 1); }

 private:
  constexpr Narrowed fitted(Narrowed out) const {
    if (out.word < to_.min || out.word > to_.max) {
      out.overflow = true;
      out.word = overflow_ == Overflow::SAT ? (out.word < to_.min ? to_.min : to_.max) : wrapped(out.word);
    }
    return out;
  }
  constexpr std::int64_t wrapped(std::int64_t word) const {
    assert(to_.word_bits > 0 && "a unit-interval format cannot wrap");
    const std::int64_t modulus = std::int64_t{1} << to_.word_bits;
    word &= modulus - 1;
    return word > to_.max ? word - modulus : word;
  }

  Rounding rounding_;
  Overflow overflow_;
  int from_frac_;
  Format to_;
  int dropped_bits_ = 0, grown_bits_ = 0;
  std::int64_t bias_ = 0;  ///< added before the bits are dropped
  std::int64_t even_ = 0;  ///< 1: ties go to even
};

/// Narrows one value, see Narrowing.
template <Rounding R, Overflow O>
constexpr Narrowed narrow(std::int64_t value, int from_frac, const Format& to) {
  return Narrowing(R, O, from_frac, to)(value);
}

}  // namespace fastsplat::cmodel
