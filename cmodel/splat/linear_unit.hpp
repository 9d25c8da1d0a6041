// SPDX-License-Identifier: Apache-2.0
// Unit "linear": weights from a table over the distance, the integer square root of the exact squared distance
// (docs/numerics.md, section 4.1). Centres are not snapped.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/numbers/integer_sqrt.hpp"
#include "cmodel/splat/footprint.hpp"
#include "cmodel/splat/set_places.hpp"
#include "cmodel/splat/squared_unit.hpp"

namespace fastsplat::cmodel {

/// Radial table steps per 2^-g of 1/K pixel: scale / 2^shift.
struct LinearScale {
  std::uint64_t scale = 0;  ///< c
  int shift = 0;            ///< h
};

/// s: the distance in 2^-g of 1/K pixel, rounded down. `squared` = dx^2 + dy^2 in 1/K pixel, squared.
constexpr std::uint64_t linear_distance(std::int64_t squared, int guard_bits) {
  return integer_sqrt(static_cast<std::uint64_t>(squared) << (2 * guard_bits));
}
/// t: the radial table's index.
constexpr std::uint64_t linear_index(std::uint64_t distance, const LinearScale& set) {
  return (distance * set.scale) >> set.shift;
}

class LinearUnit {
 public:
  explicit LinearUnit(const Config& config)
      : guard_bits_(config.rlut_guard_bits),
        places_(config),
        radial_(config),
        scan_(config),
        sets_(static_cast<std::size_t>(config.rlut_sets)) {}

  void load(const LoadTable& table) {
    places_.load(table.radius);
    sets_[table.radius.set] = {.scale = table.words[0], .shift = static_cast<int>(table.words[1])};
  }
  void load_radial(std::span<const std::uint32_t> words) { radial_.load(words); }
  std::uint32_t rho(std::uint32_t set) const { return places_.rho(set); }
  std::uint32_t extent(std::uint32_t set) const { return places_.extent(set); }

  void place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y) {
    constexpr Quadric kSquaredDistance{.a = 1, .b = 0, .c = 1, .shift = 0};
    scan_.place(places_, kSquaredDistance, set, x, y);
    scale_ = sets_[set];
  }
  template <class Observer>
  void window(std::uint32_t column, std::uint32_t row, std::span<std::uint32_t> weights, Observer& observer) {
    const auto squared = scan_.window(column, row);
    for (std::size_t lane = 0; lane < weights.size(); ++lane)
      weights[lane] = radial_.at(linear_index(linear_distance(squared[lane], guard_bits_), scale_), 0, observer);
  }

 private:
  int guard_bits_;
  SetPlaces places_;
  RadialTable radial_;
  WindowScan scan_;
  std::vector<LinearScale> sets_;
  LinearScale scale_;
};

}  // namespace fastsplat::cmodel
