// Splats by bands of image rows: a band is a tile as wide as the image.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

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
  return {from(splat.x), to(splat.x), from(splat.y), to(splat.y), to(splat.y)};
}

/// Splats by the band they touch and a sheet, in their order.
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
  /// Splats of each band.
  std::span<const std::uint64_t> work() const { return work_; }

 private:
  int sheets_;
  driver::TileBins bins_;
  std::vector<std::uint64_t> work_;
};

}  // namespace fastsplat::stages
