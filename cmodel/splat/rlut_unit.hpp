// SPDX-License-Identifier: Apache-2.0
// Unit "rlut": weights from a table over the squared distance, the sum of two words read by window phase (N-4-6). The
// index kind of rtl/.
#pragma once

#include <cstdint>
#include <span>

#include "cmodel/splat/footprint.hpp"
#include "cmodel/splat/rlut.hpp"
#include "cmodel/splat/snap.hpp"

namespace fastsplat::cmodel {

class RlutUnit {
 public:
  explicit RlutUnit(const Config& config) : rlut_(config), radial_(config) {}

  void load(const LoadTable& table) { rlut_.load(table); }
  void load_radial(std::span<const std::uint32_t> words) { radial_.load(words); }
  std::uint32_t rho(std::uint32_t set) const { return rlut_.rho(set); }
  std::uint32_t extent(std::uint32_t set) const { return rlut_.extent(set); }

  void place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y) { set_ = set, x_ = x.phase, y_ = y.phase; }
  template <class Observer>
  void window(std::uint32_t column, std::uint32_t row, std::span<std::uint32_t> weights, Observer& observer) {
    footprint(radial_, rlut_.read(set_, x_, column), rlut_.read(set_, y_, row), weights, observer);
  }

  const Rlut& rlut() const { return rlut_; }
  const RadialTable& radial() const { return radial_; }

 private:
  Rlut rlut_;
  RadialTable radial_;
  std::uint32_t set_ = 0, x_ = 0, y_ = 0;  ///< of the current splat
};

}  // namespace fastsplat::cmodel
