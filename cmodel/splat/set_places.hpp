// SPDX-License-Identifier: Apache-2.0
// Footprint sizes of the loaded radius sets and places of their pixels, for index kinds without columns.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "cmodel/splat/snap.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

class SetPlaces {
 public:
  explicit SetPlaces(const Config& config) : config_(config), sets_(static_cast<std::size_t>(config.rlut_sets)) {}

  void load(const RadiusSet& radius) {
    sets_[radius.set] = {.rho = radius.rho, .extent = window_geometry(config_, radius.rho).padded};
  }
  std::uint32_t rho(std::uint32_t set) const { return sets_[set].rho; }
  /// Ea: footprint extent in pixels, a multiple of P.
  std::uint32_t extent(std::uint32_t set) const { return sets_[set].extent; }

  /// d = (i+1) K - m - rho: how far pixel `i` of the footprint lies from the centre along one axis, 1/K pixel.
  std::int64_t distance(std::uint32_t set, std::uint32_t phase, std::uint32_t i) const {
    return (std::int64_t{i} + 1) * config_.grid() - phase - sets_[set].rho;
  }

 private:
  struct Set {
    std::uint32_t rho = 0, extent = 0;
  };
  Config config_;
  std::vector<Set> sets_;
};

}  // namespace fastsplat::cmodel
