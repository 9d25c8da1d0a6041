// SPDX-License-Identifier: Apache-2.0
// Units "squared" and "squared_elliptic": weights from a table over q, the squared distance in radial table steps, by
// forward differences (docs/numerics.md, sections 4.2 and 4.3). Centres are not snapped.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/splat/footprint.hpp"
#include "cmodel/splat/quadric.hpp"
#include "cmodel/splat/set_places.hpp"

namespace fastsplat::cmodel {

/// From a set's words: c, h of a circle; A, B, C, h of an ellipse.
inline Quadric quadric_of(std::span<const std::uint32_t> words) {
  if (words.size() == 2) return {.a = words[0], .b = 0, .c = words[0], .shift = static_cast<int>(words[1])};
  return {.a = words[0], .b = static_cast<std::int32_t>(words[1]), .c = words[2], .shift = static_cast<int>(words[3])};
}

/// Goes through a footprint's windows along scan lines; cmodel/splat/weight_unit.hpp describes the functions.
class WindowScan {
 public:
  explicit WindowScan(const Config& config) : lanes_(static_cast<std::uint32_t>(config.lanes)), scan_(config) {}

  void place(const SetPlaces& places, const Quadric& f, std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y) {
    quadric_ = f;
    first_x_ = places.distance(set, x.phase, 0);
    first_y_ = places.distance(set, y.phase, 0);
    pixel_ = places.distance(set, x.phase, 1) - first_x_;
    next_column_ = kNone;
  }
  /// q of the window's pixels: by two additions a pixel if the window is to the right of the last one.
  std::span<const std::int64_t> window(std::uint32_t column, std::uint32_t row) {
    if (column == next_column_ && row == row_) {
      scan_.next();
    } else {
      scan_.begin(quadric_, first_x_ + pixel_ * column, first_y_ + pixel_ * row);
    }
    next_column_ = column + lanes_;
    row_ = row;
    return scan_.values();
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::uint32_t lanes_;
  QuadricScan scan_;
  Quadric quadric_;
  std::int64_t first_x_ = 0, first_y_ = 0;  ///< distance of the first pixel from the centre, 1/K pixel
  std::int64_t pixel_ = 0;                  ///< K
  std::uint32_t next_column_ = kNone, row_ = 0;
};

class SquaredUnit {
 public:
  explicit SquaredUnit(const Config& config)
      : places_(config),
        radial_(config),
        scan_(config),
        guard_bits_(config.rlut_guard_bits),
        sets_(static_cast<std::size_t>(config.rlut_sets)) {}

  void load(const LoadTable& table) {
    places_.load(table.radius);
    sets_[table.radius.set] = quadric_of(table.words);
  }
  void load_radial(std::span<const std::uint32_t> words) { radial_.load(words); }
  std::uint32_t rho(std::uint32_t set) const { return places_.rho(set); }
  std::uint32_t extent(std::uint32_t set) const { return places_.extent(set); }

  void place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y) {
    scan_.place(places_, sets_[set], set, x, y);
    shift_ = sets_[set].shift;
  }
  template <class Observer>
  void window(std::uint32_t column, std::uint32_t row, std::span<std::uint32_t> weights, Observer& observer) {
    const auto q = scan_.window(column, row);
    for (std::size_t lane = 0; lane < weights.size(); ++lane)
      weights[lane] = radial_.at(quadric_index(q[lane], shift_), quadric_steps(q[lane], shift_, guard_bits_), observer);
  }

 private:
  SetPlaces places_;
  RadialTable radial_;
  WindowScan scan_;
  int guard_bits_;
  std::vector<Quadric> sets_;
  int shift_ = 0;
};

}  // namespace fastsplat::cmodel
