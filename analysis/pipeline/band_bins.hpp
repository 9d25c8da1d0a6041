// SPDX-License-Identifier: Apache-2.0
// Splats by bands of image rows: a band is a tile as wide as the image.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/pipeline/splat_steps.hpp"
#include "driver/tiles/tile_bins.hpp"

namespace fastsplat::stages {

inline driver::TileGrid band_grid(const cmodel::Config& config, int width, int height, int rows) {
  driver::TileGrid grid(config, width, height);
  grid.tile_width = width;
  grid.tile_height = rows;
  return grid;
}

/// How far a splat's pixels lie from its centre along x and y, pixels.
struct Reach {
  double x = 0.0, y = 0.0;
};
/// `more`: for circles. Rounding may move pixels beyond an ellipse's edge inside.
inline Reach reach_of(const StagedSplat& splat, const StagedShape* shape, double more) {
  if (shape != nullptr && shape->own) return {shape->reach_x + shape->beyond, shape->reach_y + shape->beyond};
  return {splat.radius + more, splat.radius + more};
}

inline driver::Extent extent_of(const StagedSplat& splat, const StagedShape* shape = nullptr, double more = 0.0) {
  const Reach reach = reach_of(splat, shape, more);
  const auto from = [](double at, double far) { return static_cast<std::int32_t>(std::ceil(at - far)); };
  const auto to = [](double at, double far) { return static_cast<std::int32_t>(std::floor(at + far)) + 1; };
  const std::int32_t bottom = to(splat.y, reach.y);
  return {from(splat.x, reach.x), to(splat.x, reach.x), from(splat.y, reach.y), bottom, bottom};
}

/// Splats by band and sheet; a bin keeps their order.
class BandBins {
 public:
  template <class ExtentOf, class SheetOf>
  BandBins(const driver::TileGrid& bands, int sheets, std::size_t splats, int threads, ExtentOf extent, SheetOf sheet)
      : sheets_(sheets),
        bins_(bands, driver::Bands(bands, bands.tile_height), {}, sheets, splats, threads, extent, sheet) {
    for (int band = 0; band < bands.count(); ++band) work_.push_back(bins_.count(band, 0));
  }
  int sheets() const { return sheets_; }
  std::span<const std::uint32_t> bin(int band, int sheet) const { return bins_.bin(band, 0, sheet); }
  /// Number of splats in each band.
  std::span<const std::uint64_t> work() const { return work_; }

 private:
  int sheets_;
  driver::TileBins bins_;
  std::vector<std::uint64_t> work_;
};

}  // namespace fastsplat::stages
