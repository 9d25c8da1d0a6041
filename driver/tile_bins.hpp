// Which splats touch which tile, ordered by the first sheet they reach.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/config.hpp"

namespace fastsplat::driver {

/// The image cut into the device's tiles, row by row; the last column and row may be narrower.
struct TileGrid {
  int image_width = 0, image_height = 0, tile_width = 0, tile_height = 0;

  TileGrid(const cmodel::Config& config, int width, int height)
      : image_width(width), image_height(height), tile_width(config.tile_width), tile_height(config.tile_height) {}
  int columns() const { return (image_width + tile_width - 1) / tile_width; }
  int rows() const { return (image_height + tile_height - 1) / tile_height; }
  int count() const { return columns() * rows(); }
  int x(int tile) const { return tile % columns() * tile_width; }
  int y(int tile) const { return tile / columns() * tile_height; }
  int width(int tile) const { return x(tile) + tile_width <= image_width ? tile_width : image_width - x(tile); }
  int height(int tile) const { return y(tile) + tile_height <= image_height ? tile_height : image_height - y(tile); }
};

/// Pixels that a splat may touch: [x0,x1) x [y0,y1) of the image, unclipped.
struct Extent {
  std::int32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

/// Counting sort of splat numbers by (tile, first sheet); stable, so traversal order stays within a bin.
class TileBins {
 public:
  /// extent(i) and first_sheet(i) for i in [0, splats).
  template <class ExtentOf, class SheetOf>
  TileBins(const TileGrid& grid, int sheets, std::size_t splats, ExtentOf extent, SheetOf first_sheet)
      : sheets_(static_cast<std::size_t>(sheets)), start_(static_cast<std::size_t>(grid.count()) * sheets_ + 1, 0) {
    visit(grid, splats, extent, first_sheet, [this](std::size_t bin, std::uint32_t) { ++start_[bin + 1]; });
    for (std::size_t bin = 1; bin < start_.size(); ++bin) start_[bin] += start_[bin - 1];
    order_.resize(start_.back());
    std::vector<std::uint64_t> next(start_.begin(), start_.end() - 1);
    visit(grid, splats, extent, first_sheet,
          [&](std::size_t bin, std::uint32_t splat) { order_[next[bin]++] = splat; });
  }

  std::span<const std::uint32_t> bin(int tile, int sheet) const {
    const std::size_t at = static_cast<std::size_t>(tile) * sheets_ + static_cast<std::size_t>(sheet);
    return {order_.data() + start_[at], order_.data() + start_[at + 1]};
  }

 private:
  template <class ExtentOf, class SheetOf, class Visit>
  void visit(const TileGrid& grid, std::size_t splats, ExtentOf extent, SheetOf first_sheet, Visit visit) const {
    for (std::size_t i = 0; i < splats; ++i) {
      const Extent e = extent(i);
      const int tx0 = e.x0 < 0 ? 0 : e.x0 / grid.tile_width, tx1 = e.x1 <= 0 ? -1 : (e.x1 - 1) / grid.tile_width;
      const int ty0 = e.y0 < 0 ? 0 : e.y0 / grid.tile_height, ty1 = e.y1 <= 0 ? -1 : (e.y1 - 1) / grid.tile_height;
      for (int ty = ty0; ty <= ty1 && ty < grid.rows(); ++ty) {
        for (int tx = tx0; tx <= tx1 && tx < grid.columns(); ++tx) {
          const std::size_t tile = static_cast<std::size_t>(ty) * grid.columns() + tx;
          visit(tile * sheets_ + static_cast<std::size_t>(first_sheet(i)), static_cast<std::uint32_t>(i));
        }
      }
    }
  }

  std::size_t sheets_;
  std::vector<std::uint64_t> start_;  ///< per (tile, sheet)
  std::vector<std::uint32_t> order_;  ///< splat numbers
};

}  // namespace fastsplat::driver
