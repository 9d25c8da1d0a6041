// SPDX-License-Identifier: Apache-2.0
// Unit "separable": weight = g(dx) g(dy), which holds for Gaussians only (docs/numerics.md, section 4.5). One
// multiplier a lane instead of adder and radial table.
#pragma once

#include <cstdint>
#include <span>

#include "cmodel/numbers/sites.hpp"
#include "cmodel/splat/rlut.hpp"
#include "cmodel/splat/snap.hpp"

namespace fastsplat::cmodel {

class SeparableUnit {
 public:
  explicit SeparableUnit(const Config& config) : axis_(config), narrow_(config) {}

  void load(const LoadTable& table) { axis_.load(table); }
  /// Ignored: weights are in the columns (N-4.5-4).
  void load_radial(std::span<const std::uint32_t> /*words*/) {}
  std::uint32_t rho(std::uint32_t set) const { return axis_.rho(set); }
  std::uint32_t extent(std::uint32_t set) const { return axis_.extent(set); }

  void place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y) { set_ = set, x_ = x.phase, y_ = y.phase; }
  template <class Observer>
  void window(std::uint32_t column, std::uint32_t row, std::span<std::uint32_t> weights, Observer& observer) {
    const auto columns = axis_.read(set_, x_, column), rows = axis_.read(set_, y_, row);
    std::size_t lane = 0;
    for (const std::uint32_t gy : rows) {
      for (const std::uint32_t gx : columns) weights[lane++] = weight(gx, gy, observer);
    }
  }
  /// U wi.wf of two words with wf + g fraction bits.
  template <class Observer>
  std::uint32_t weight(std::uint32_t gx, std::uint32_t gy, Observer& observer) const {
    return static_cast<std::uint32_t>(narrow_(std::int64_t{gx} * gy, observer));
  }

 private:
  Rlut axis_;  ///< the RLUT's memory with other words: [phase][column]
  NarrowAt<Site::AxisProduct> narrow_;
  std::uint32_t set_ = 0, x_ = 0, y_ = 0;  ///< of the current splat
};

}  // namespace fastsplat::cmodel
