// SPDX-License-Identifier: Apache-2.0
// Unit "blit2d": reads weights from precomputed footprints, one for each pair of window phases, without arithmetic
// (docs/numerics.md, section 4.4).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/set_places.hpp"

namespace fastsplat::cmodel {

/// How one axis of a footprint is stored: its stored phase and the order of its columns.
struct StoredAxis {
  std::uint32_t phase = 0;  ///< number among the stored phases
  std::int32_t first = 0;   ///< stored column of column 0
  std::int32_t step = 1;    ///< -1: mirrored
  std::int32_t operator()(std::uint32_t column) const { return first + step * static_cast<std::int32_t>(column); }
};
/// For window phase m of a set with support radius `rho`, 1/K pixel (N-4.4-3).
StoredAxis stored_axis(const Config& config, std::uint32_t rho, std::uint32_t m);

/// Where the footprint of two stored phases lies (N-4.4-4).
struct StoredFootprint {
  std::uint32_t number = 0;  ///< in the order of load_table
  bool transposed = false;   ///< rows and columns are exchanged
};
StoredFootprint stored_footprint(const Config& config, const StoredAxis& x, const StoredAxis& y);

class BlitUnit {
 public:
  explicit BlitUnit(const Config& config)
      : config_(config),
        lanes_(static_cast<std::uint32_t>(config.lanes)),
        places_(config),
        sets_(static_cast<std::size_t>(config.rlut_sets)) {}

  void load(const LoadTable& table) {
    places_.load(table.radius);
    sets_[table.radius.set] = table.words;
  }
  /// Ignored: weights are in the footprints (N-4.4-9).
  void load_radial(std::span<const std::uint32_t> /*words*/) {}
  std::uint32_t rho(std::uint32_t set) const { return places_.rho(set); }
  std::uint32_t extent(std::uint32_t set) const { return places_.extent(set); }

  void place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y);
  template <class Observer>
  void window(std::uint32_t column, std::uint32_t row, std::span<std::uint32_t> weights, Observer& /*observer*/) {
    std::size_t lane = 0;
    for (std::uint32_t j = row; j < row + lanes_; ++j) {
      for (std::uint32_t i = column; i < column + lanes_; ++i) weights[lane++] = weight(i, j);
    }
  }

 private:
  std::uint32_t weight(std::uint32_t i, std::uint32_t j) const;

  Config config_;
  std::uint32_t lanes_;
  SetPlaces places_;
  std::vector<std::vector<std::uint32_t>> sets_;  ///< [footprint][row][column]
  // Of the current splat.
  StoredAxis x_, y_;
  bool transposed_ = false;
  std::int32_t side_ = 0;                     ///< Ea
  std::span<const std::uint32_t> footprint_;  ///< Ea x Ea
};

}  // namespace fastsplat::cmodel
