// Splats by bands of image rows: a band is a tile as wide as the image.
#pragma once

#include <cmath>

#include "driver/tile_bins.hpp"
#include "stages/splat_steps.hpp"

namespace fastsplat::stages {

inline driver::TileGrid band_grid(const cmodel::Config& config, int width, int height, int rows) {
  driver::TileGrid grid(config, width, height);
  grid.tile_width = width;
  grid.tile_height = rows;
  return grid;
}

/// Pixels within the splat's radius, and `more`, along both axes.
inline driver::Extent extent_of(const StagedSplat& splat, double more = 0.0) {
  const double reach = splat.radius + more;
  const auto from = [&](double at) { return static_cast<std::int32_t>(std::ceil(at - reach)); };
  const auto to = [&](double at) { return static_cast<std::int32_t>(std::floor(at + reach)) + 1; };
  return {from(splat.x), to(splat.x), from(splat.y), to(splat.y)};
}

}  // namespace fastsplat::stages
