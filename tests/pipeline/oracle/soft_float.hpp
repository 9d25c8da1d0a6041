// SPDX-License-Identifier: Apache-2.0
// Addition and multiplication of binary floating-point words in integers, from the text of IEEE 754-2019 (3.4, 4.3.1,
// 5.4.1): round to nearest, ties to even, subnormals. An oracle for stages::RoundToFloat.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace fastsplat::stages::oracle {

/// Words of 1 + kExponent + kFraction bits.
template <int kExponent, int kFraction>
struct SoftFloat {
  static constexpr std::uint32_t kOne = 1U << kFraction, kSign = 1U << (kExponent + kFraction),
                                 kInfinity = ((1U << kExponent) - 1) << kFraction, kNan = kInfinity | (kOne >> 1);
  static constexpr int kBias = (1 << (kExponent - 1)) - 1, kLeast = 1 - kBias - kFraction;  ///< of a unit

  static bool is_nan(std::uint32_t word) { return (word & ~kSign) > kInfinity; }
  static bool is_infinite(std::uint32_t word) { return (word & ~kSign) == kInfinity; }
  /// significand * 2^unit
  struct Parts {
    std::uint64_t significand;
    int unit;
  };
  static Parts parts(std::uint32_t word) {
    const std::uint32_t biased = (word & ~kSign) >> kFraction, fraction = word & (kOne - 1);
    return biased == 0 ? Parts{fraction, kLeast} : Parts{fraction | kOne, kLeast + static_cast<int>(biased) - 1};
  }
  static double value(std::uint32_t word) {
    const double sign = (word & kSign) != 0 ? -1.0 : 1.0;
    if (is_nan(word)) return NAN;
    if (is_infinite(word)) return sign * HUGE_VAL;
    const Parts p = parts(word);
    return sign * std::ldexp(static_cast<double>(p.significand), p.unit);
  }

  /// Rounds (significand + sticky) * 2^unit; `sticky`: more than 0 and less than 1.
  static std::uint32_t rounded(std::uint32_t sign, std::uint64_t significand, int unit, bool sticky = false) {
    if (significand == 0) return sign;
    const int length = 64 - std::countl_zero(significand);
    const int result = std::max(unit + length - 1 - kFraction, kLeast), dropped = result - unit;
    std::uint64_t kept = significand;
    if (dropped > 0) {
      // What is dropped may be longer than the significand.
      const std::uint64_t rest = dropped < 64 ? significand & ((std::uint64_t{1} << dropped) - 1) : significand;
      kept = dropped < 64 ? significand >> dropped : 0;
      const std::uint64_t half = dropped <= 64 ? std::uint64_t{1} << (dropped - 1) : ~std::uint64_t{0};
      if (rest > half || (rest == half && (sticky || (kept & 1) != 0))) ++kept;
    } else {
      kept <<= -dropped;
    }
    // A carry into the exponent, and from the subnormal numbers, by addition.
    const auto biased = static_cast<std::uint64_t>(result - kLeast);
    const std::uint64_t word = (biased << kFraction) + kept;
    return sign | static_cast<std::uint32_t>(std::min<std::uint64_t>(word, kInfinity));
  }

  static std::uint32_t times(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t sign = (a ^ b) & kSign;
    if (is_nan(a) || is_nan(b)) return kNan;
    const Parts p = parts(a), q = parts(b);
    if (is_infinite(a) || is_infinite(b)) return p.significand == 0 || q.significand == 0 ? kNan : sign | kInfinity;
    return rounded(sign, p.significand * q.significand, p.unit + q.unit);
  }

  static std::uint32_t plus(std::uint32_t a, std::uint32_t b) {
    if (is_nan(a) || is_nan(b)) return kNan;
    if (is_infinite(a)) return is_infinite(b) && a != b ? kNan : a;
    if (is_infinite(b)) return b;
    if ((a & ~kSign) < (b & ~kSign)) std::swap(a, b);
    Parts large = parts(a), small = parts(b);
    // So many bits below the larger one that the smaller one is exact, or only a sticky bit.
    constexpr int kRoom = 40;
    large.significand <<= kRoom, large.unit -= kRoom;
    const int apart = small.unit - large.unit;
    bool sticky = false;
    if (apart >= 0) {
      small.significand <<= apart;
    } else {
      sticky = small.significand != 0;
      small.significand = 0;
    }
    if (((a ^ b) & kSign) == 0) return rounded(a & kSign, large.significand + small.significand, large.unit, sticky);
    // One less and the rest above it.
    const std::uint64_t difference = large.significand - small.significand - (sticky ? 1 : 0);
    return difference == 0 && !sticky ? 0 : rounded(a & kSign, difference, large.unit, sticky);
  }
};

}  // namespace fastsplat::stages::oracle
