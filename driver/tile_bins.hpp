// Which splats touch which tile, ordered by the first sheet they reach.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel/parallel.hpp"
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
  /// extent(i) and first_sheet(i) for i in [0, splats): each asked for once, by several threads.
  template <class ExtentOf, class SheetOf>
  TileBins(const TileGrid& grid, int sheets, std::size_t splats, int threads, ExtentOf extent, SheetOf first_sheet)
      : sheets_(static_cast<std::size_t>(sheets)), start_(static_cast<std::size_t>(grid.count()) * sheets_ + 1, 0) {
    std::vector<Place> places(splats);
    const Columns across(grid.columns(), grid.tile_width), down(grid.rows(), grid.tile_height);
    constexpr std::size_t kPiece = 1 << 16;
    parallel_for((splats + kPiece - 1) / kPiece, threads, [&](std::size_t piece) {
      for (std::size_t i = piece * kPiece; i < std::min(splats, (piece + 1) * kPiece); ++i) {
        const Extent e = extent(i);
        places[i] = {across.first(e.x0), across.last(e.x1), down.first(e.y0), down.last(e.y1), first_sheet(i)};
      }
    });
    for (const Place& place : places) visit(grid, place, [this](std::size_t bin) { ++start_[bin + 1]; });
    for (std::size_t bin = 1; bin < start_.size(); ++bin) start_[bin] += start_[bin - 1];
    order_.resize(start_.back());
    std::vector<std::uint64_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < splats; ++i)
      visit(grid, places[i], [&](std::size_t bin) { order_[next[bin]++] = static_cast<std::uint32_t>(i); });
  }

  std::span<const std::uint32_t> bin(int tile, int sheet) const {
    const std::size_t at = static_cast<std::size_t>(tile) * sheets_ + static_cast<std::size_t>(sheet);
    return {order_.data() + start_[at], order_.data() + start_[at + 1]};
  }
  /// All bins of a tile, one after the other.
  std::span<const std::uint32_t> tile(int tile) const {
    const std::size_t at = static_cast<std::size_t>(tile) * sheets_;
    return {order_.data() + start_[at], order_.data() + start_[at + sheets_]};
  }

 private:
  /// The tiles a splat touches, and its first sheet.
  struct Place {
    std::int16_t tx0, tx1, ty0, ty1;  ///< the last ones included
    std::int32_t sheet;
  };
  /// Tiles along one axis, looked up by pixel: a division each is what most of the binning would cost.
  class Columns {
   public:
    /// The last tile counts as a whole one, even where the image ends within it.
    Columns(int tiles, int tile) {
      for (int at = 0; at < tiles * tile; ++at) tile_.push_back(static_cast<std::int16_t>(at / tile));
    }
    /// Of the interval's first pixel; behind the last one if it begins there.
    std::int16_t first(std::int32_t begin) const {
      if (begin < 0) return 0;
      return begin < size() ? tile_[static_cast<std::size_t>(begin)] : static_cast<std::int16_t>(tile_.back() + 1);
    }
    /// Of the interval's last pixel; -1 if it ends before the first one.
    std::int16_t last(std::int32_t end) const {
      return end <= 0 ? static_cast<std::int16_t>(-1) : tile_[static_cast<std::size_t>(std::min(end, size()) - 1)];
    }

   private:
    std::int32_t size() const { return static_cast<std::int32_t>(tile_.size()); }
    std::vector<std::int16_t> tile_;
  };
  template <class Visit>
  void visit(const TileGrid& grid, const Place& place, Visit visit) const {
    for (int ty = place.ty0; ty <= place.ty1; ++ty) {
      for (int tx = place.tx0; tx <= place.tx1; ++tx) {
        const std::size_t tile =
            static_cast<std::size_t>(ty) * static_cast<std::size_t>(grid.columns()) + static_cast<std::size_t>(tx);
        visit(tile * sheets_ + static_cast<std::size_t>(place.sheet));
      }
    }
  }

  std::size_t sheets_;
  std::vector<std::uint64_t> start_;  ///< per (tile, sheet)
  std::vector<std::uint32_t> order_;  ///< splat numbers
};

}  // namespace fastsplat::driver
