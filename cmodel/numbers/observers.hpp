// SPDX-License-Identifier: Apache-2.0
// Observers of the narrowing sites (cmodel/numbers/sites.hpp): none, the device's counters, ranges of values, or two of
// them. An observer is any type callable with (Site, const Narrowing&, value, const Narrowed&).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "cmodel/numbers/counters.hpp"
#include "cmodel/numbers/sites.hpp"
#include "cmodel/numbers/wide_sum.hpp"

namespace fastsplat::cmodel {

struct Nothing {
  void operator()(Site /*site*/, const Narrowing& /*narrowing*/, std::int64_t /*value*/, const Narrowed& /*to*/) {}
};

/// The device's counters: an overflow increments its site's counter.
struct Counting {
  Counters& counters;
  void operator()(Site site, const Narrowing& /*narrowing*/, std::int64_t /*value*/, const Narrowed& narrowed) {
    if (const auto counts = facts(site).counts) counters.*counts += narrowed.overflow ? 1 : 0;
  }
};

/// Statistics of the values at one site. Without values count = 0 and least > greatest.
struct Range {
  std::uint64_t count = 0;
  std::uint64_t inexact = 0;                                         ///< values that lost a 1 bit
  std::uint64_t overflow = 0;                                        ///< results outside the format
  std::int64_t least = std::numeric_limits<std::int64_t>::max();     ///< before narrowing, from_frac() fraction bits
  std::int64_t greatest = std::numeric_limits<std::int64_t>::min();  ///< likewise
  std::int64_t dropped = 0;                                          ///< which of the dropped bits were ever 1
  std::int64_t ones = 0;                                             ///< which bits of the words were ever 1
  /// Sums over words inside the format: word - value, and its square, in steps of 2^-from_frac().
  WideSum error{}, error_squares{};
  /// Histogram of magnitudes before narrowing: leading[n] counts those whose leading bit is bit n-1, leading[0] zeros.
  std::array<std::uint64_t, 64> leading{};

  Range& operator+=(const Range& other) {
    count += other.count;
    inexact += other.inexact;
    overflow += other.overflow;
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
    dropped |= other.dropped;
    ones |= other.ones;
    error += other.error;
    error_squares += other.error_squares;
    for (std::size_t bit = 0; bit < leading.size(); ++bit) leading[bit] += other.leading[bit];
    return *this;
  }
  bool operator==(const Range&) const = default;

  /// Low bits that are 0 in every word; all bits if every word is 0.
  int idle_tail(const Narrowing& narrowing) const {
    const int bits = std::bit_width(static_cast<std::uint64_t>(narrowing.to().max));
    return ones == 0 ? bits : std::countr_zero(static_cast<std::uint64_t>(ones));
  }
  /// Additional fraction bits with which nothing would have been lost.
  int missing_bits(const Narrowing& narrowing) const {
    return dropped == 0 ? 0 : narrowing.dropped_bits() - std::countr_zero(static_cast<std::uint64_t>(dropped));
  }
  /// Integer bits that were never needed, without the sign; if negative, the number of missing bits.
  int headroom(const Narrowing& narrowing) const {
    return magnitude_bits(narrowing.to().min, narrowing.to().max) -
           magnitude_bits(unbounded(narrowing, least), unbounded(narrowing, greatest));
  }

 private:
  /// The word in a format without limits.
  static std::int64_t unbounded(const Narrowing& narrowing, std::int64_t value) {
    constexpr Format kAny{std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(), 0, 0};
    Format wide = kAny;
    wide.frac_bits = narrowing.to().frac_bits;
    return Narrowing(narrowing.rounding(), Overflow::SAT, narrowing.from_frac(), wide)(value).word;
  }
  static int magnitude_bits(std::int64_t least, std::int64_t greatest) {
    const std::int64_t largest = std::max(greatest, least < 0 ? -(least + 1) : std::int64_t{0});
    return std::bit_width(static_cast<std::uint64_t>(std::max(largest, std::int64_t{0})));
  }
};

/// The range of every site.
class Ranges {
 public:
  const Range& at(Site site) const { return ranges_[static_cast<std::size_t>(site)]; }
  void operator()(Site site, const Narrowing& narrowing, std::int64_t value, const Narrowed& narrowed) {
    Range& range = ranges_[static_cast<std::size_t>(site)];
    ++range.count;
    range.inexact += narrowed.inexact ? 1 : 0;
    range.overflow += narrowed.overflow ? 1 : 0;
    range.least = std::min(range.least, value);
    range.greatest = std::max(range.greatest, value);
    range.dropped |= narrowing.dropped(value);
    range.ones |= narrowed.word;
    ++range.leading[static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(value < 0 ? -value : value)))];
    if (!narrowed.inexact || narrowed.overflow) return;
    const std::int64_t error = narrowed.word * (std::int64_t{1} << narrowing.dropped_bits()) - value;
    range.error.add(error);
    range.error_squares.add_square(error);
  }
  /// Merges what both observed.
  Ranges& operator+=(const Ranges& other) {
    for (std::size_t site = 0; site < ranges_.size(); ++site) ranges_[site] += other.ranges_[site];
    return *this;
  }
  bool operator==(const Ranges&) const = default;

 private:
  std::array<Range, kSiteCount> ranges_;
};

template <class First, class Second>
struct Both {
  First& first;
  Second& second;
  void operator()(Site site, const Narrowing& narrowing, std::int64_t value, const Narrowed& narrowed) {
    first(site, narrowing, value, narrowed);
    second(site, narrowing, value, narrowed);
  }
};

}  // namespace fastsplat::cmodel
