// SPDX-License-Identifier: Apache-2.0
// Unit "lane": pure functions for one pixel of a window, from squared distance to sum (docs/numerics.md, sections 4 and
// 5; rtl/splat/fastsplat_lane.sv, and the sum of rtl/splat/fastsplat_sheet_bank.sv).
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/numbers/sites.hpp"

namespace fastsplat::cmodel {

/// One pixel's sums, U si.sf: R, G, B, tau.
using SheetWord = std::array<std::uint32_t, 4>;

/// t: the radial table's index at q, the sum of two RLUT words with `guard_bits` fraction bits. N or more at and beyond
/// the rim.
constexpr std::uint32_t radial_index(std::uint32_t q, int guard_bits) { return q >> guard_bits; }

class Lane {
 public:
  explicit Lane(const Config& config) : product_(config), sum_(config) {}

  /// p_c of one channel: colour U 0.cf times weight U wi.wf, as U si.sf.
  template <class Observer>
  std::uint32_t product(std::uint32_t colour, std::uint32_t weight, Observer& observer) const {
    return static_cast<std::uint32_t>(product_(std::int64_t{colour} * weight, observer));
  }
  /// S_c after p_c, both U si.sf.
  template <class Observer>
  std::uint32_t accumulate(std::uint32_t sum, std::uint32_t product, Observer& observer) const {
    return static_cast<std::uint32_t>(sum_(std::int64_t{sum} + product, observer));
  }

 private:
  NarrowAt<Site::Product> product_;
  NarrowAt<Site::Sum> sum_;
};

}  // namespace fastsplat::cmodel
