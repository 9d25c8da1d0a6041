// SPDX-License-Identifier: Apache-2.0
// Sorts splats by the tiles that they touch and by the first sheet that they reach.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel/parallel.hpp"
#include "base/uninitialised.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::driver {

/// The image cut into the device's tiles, row by row; the last column and row may be narrower.
struct TileGrid {
  int image_width = 0, image_height = 0, tile_width = 0, tile_height = 0;

  /// `halo`: pixels on each side of the picture's tile that the device's tile also holds.
  TileGrid(const cmodel::Config& config, int width, int height, int halo = 0)
      : image_width(width),
        image_height(height),
        tile_width(config.tile_width - 2 * halo),
        tile_height(config.tile_height - 2 * halo) {}
  int columns() const { return (image_width + tile_width - 1) / tile_width; }
  int rows() const { return (image_height + tile_height - 1) / tile_height; }
  int count() const { return columns() * rows(); }
  int x(int tile) const { return tile % columns() * tile_width; }
  int y(int tile) const { return tile / columns() * tile_height; }
  int width(int tile) const { return x(tile) + tile_width <= image_width ? tile_width : image_width - x(tile); }
  int height(int tile) const { return y(tile) + tile_height <= image_height ? tile_height : image_height - y(tile); }
};

/// Tiles cut into bands of whole rows of blocks, drawn separately so that a tile can keep several threads busy. Bands
/// of all tiles are numbered from the top of the image; rows below the image belong to the last band with a pixel.
class Bands {
 public:
  /// `rows`: pixels, a multiple of P. From a tile's height on, every tile is one band.
  Bands(const TileGrid& grid, int rows)
      : tile_height_(grid.tile_height),
        image_height_(grid.image_height),
        rows_(std::min(rows, grid.tile_height)),
        of_tile_((tile_height_ + rows_ - 1) / rows_) {}
  int of_tile() const { return of_tile_; }
  /// The band of a pixel's row.
  int number(int y) const {
    y = std::min(y, image_height_ - 1);
    return y / tile_height_ * of_tile_ + y % tile_height_ / rows_;
  }
  /// First row and height of band b of a tile `height` pixels high; height 0: the band has no pixel of the image.
  int first_row(int band) const { return band * rows_; }
  int height(int band, int height) const { return std::clamp(height - first_row(band), 0, rows_); }

 private:
  int tile_height_, image_height_, rows_, of_tile_;
};

/// Pixels that a splat may touch: [x0,x1) x [y0,y1) of the image, unclipped. In a tile that they meet, its windows
/// extend down to window_end with weights 0.
struct Extent {
  std::int32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0, window_end = 0;
};

/// `e` grown by `halo` pixels on each side.
inline Extent widened(const Extent& e, int halo) {
  return {e.x0 - halo, e.x1 + halo, e.y0 - halo, e.y1 + halo, e.window_end + halo};
}

/// A tile cut into square cull cells, row by row (docs/numerics.md, N-8-55); a single cell: no cull groups.
class Cells {
 public:
  Cells() = default;
  /// `side` in pixels.
  Cells(const TileGrid& grid, int side)
      : side_(side), columns_((grid.tile_width + side - 1) / side), rows_((grid.tile_height + side - 1) / side) {}
  int count() const { return columns_ * rows_; }
  /// The cell of windows that begin at this pixel, relative to the tile.
  int number(std::int32_t x, std::int32_t y) const {
    if (count() == 1) return 0;
    return std::clamp(y / side_, 0, rows_ - 1) * columns_ + std::clamp(x / side_, 0, columns_ - 1);
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int side() const { return side_; }

 private:
  int side_ = 1, columns_ = 1, rows_ = 1;
};

/// Counting sort of splat numbers by (band of a tile, first sheet, cell of the tile); stable, so traversal order stays
/// within a bin.
class TileBins {
 public:
  /// extent(i) and first_sheet(i) for i in [0, splats) are called once each, by several threads. With several cells a
  /// tile must be one band.
  template <class ExtentOf, class SheetOf>
  TileBins(const TileGrid& grid, const Bands& bands, const Cells& cells, int sheets, std::size_t splats, int threads,
           ExtentOf extent, SheetOf first_sheet)
      : columns_(static_cast<std::size_t>(grid.columns())),
        bands_(static_cast<std::size_t>(bands.of_tile())),
        sheets_(static_cast<std::size_t>(sheets)),
        cells_(static_cast<std::size_t>(cells.count())) {
    assert(cells_ == 1 || bands_ == 1);
    Uninitialised<Place> places(splats);
    const Intervals across(grid.columns() * grid.tile_width, [&](int x) { return x / grid.tile_width; });
    const Intervals down(grid.rows() * grid.tile_height, [&](int y) { return y / grid.tile_height; });
    const Intervals rows(grid.rows() * grid.tile_height, [&](int y) { return bands.number(y); });
    const auto place = [&](std::size_t i) -> Place {
      const Extent e = extent(i);
      const int tiles_end = (down.last(e.y1) + 1) * bands.of_tile() - 1;
      return {across.first(e.x0),
              across.last(e.x1),
              rows.first(e.y0),
              static_cast<std::int16_t>(std::min<int>(rows.last(e.window_end), tiles_end)),
              first_sheet(i),
              e.x0,
              e.y0};
    };
    // Cull cell of a splat in tile (x, y).
    const auto cell = [&](const Place& at, int x, int y) -> std::size_t {
      if (cells_ == 1) return 0;
      return static_cast<std::size_t>(cells.number(at.px - x * grid.tile_width, at.py - y * grid.tile_height));
    };
    // Each part of the splats is counted separately; the counts then give its start in each bin.
    const std::size_t bins = static_cast<std::size_t>(grid.count()) * bands_ * sheets_ * cells_;
    const std::size_t parts = parts_of(splats, bins, threads);
    const auto begin = [&](std::size_t part) { return splats * part / parts; };
    std::vector<std::vector<std::uint32_t>> next(parts);
    parallel_for(parts, threads, [&](std::size_t part) {
      next[part].assign(bins, 0);
      for (std::size_t i = begin(part); i < begin(part + 1); ++i) {
        places[i] = place(i);
        visit(places[i], cell, [&](std::size_t bin) { ++next[part][bin]; });
      }
    });
    start_.resize(bins + 1);
    std::uint64_t total = 0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      start_[bin] = total;
      for (auto& part : next) {
        const std::uint32_t count = part[bin];
        part[bin] = static_cast<std::uint32_t>(total - start_[bin]);
        total += count;
      }
    }
    start_[bins] = total;
    order_.resize(total);
    parallel_for(parts, threads, [&](std::size_t part) {
      for (std::size_t i = begin(part); i < begin(part + 1); ++i)
        visit(places[i], cell,
              [&](std::size_t bin) { order_[start_[bin] + next[part][bin]++] = static_cast<std::uint32_t>(i); });
    });
  }

  std::span<const std::uint32_t> bin(int tile, int band, int sheet) const {
    const std::size_t at = first_bin(tile, band) + static_cast<std::size_t>(sheet) * cells_;
    return {order_.data() + start_[at], order_.data() + start_[at + cells_]};
  }
  /// The splats of one cull cell, in a tile of one band.
  std::span<const std::uint32_t> cell(int tile, int sheet, int cell) const {
    const std::size_t at =
        first_bin(tile, 0) + static_cast<std::size_t>(sheet) * cells_ + static_cast<std::size_t>(cell);
    return {order_.data() + start_[at], order_.data() + start_[at + 1]};
  }
  /// Splats of a band, over all sheets.
  std::uint64_t count(int tile, int band) const {
    const std::size_t at = first_bin(tile, band);
    return start_[at + sheets_ * cells_] - start_[at];
  }
  /// The splats of a tile's bands, each once. `merged` is the buffer for several bands.
  std::span<const std::uint32_t> bin(int tile, int sheet, std::vector<std::uint32_t>& merged) const {
    if (bands_ == 1) return bin(tile, 0, sheet);
    merged.clear();
    for (std::size_t band = 0; band < bands_; ++band) {
      const auto more = bin(tile, static_cast<int>(band), sheet);
      const auto middle = static_cast<std::ptrdiff_t>(merged.size());
      merged.insert(merged.end(), more.begin(), more.end());
      std::inplace_merge(merged.begin(), merged.begin() + middle, merged.end());
    }
    merged.erase(std::unique(merged.begin(), merged.end()), merged.end());
    return merged;
  }

 private:
  /// The columns of tiles and the bands a splat touches, and its first sheet.
  struct Place {
    std::int16_t x0, x1, y0, y1;  ///< inclusive
    std::int32_t sheet;
    std::int32_t px, py;  ///< first pixel
  };
  /// A table from pixels to tiles or bands, along columns or rows: a division for each splat would dominate the cost of
  /// binning.
  class Intervals {
   public:
    /// The last tile counts as a whole one, even if the image ends within it.
    template <class NumberOf>
    Intervals(int pixels, NumberOf number) {
      for (int at = 0; at < pixels; ++at) number_.push_back(static_cast<std::int16_t>(number(at)));
    }
    /// The number at pixel `begin`; one past the last if `begin` lies beyond it.
    std::int16_t first(std::int32_t begin) const {
      if (begin < 0) return 0;
      return begin < size() ? number_[static_cast<std::size_t>(begin)] : static_cast<std::int16_t>(number_.back() + 1);
    }
    /// The number at pixel `end` - 1; -1 if that lies before the first.
    std::int16_t last(std::int32_t end) const {
      return end <= 0 ? static_cast<std::int16_t>(-1) : number_[static_cast<std::size_t>(std::min(end, size()) - 1)];
    }

   private:
    std::int32_t size() const { return static_cast<std::int32_t>(number_.size()); }
    std::vector<std::int16_t> number_;
  };
  /// One part per thread, unless their counters would outnumber the splats.
  static std::size_t parts_of(std::size_t splats, std::size_t bins, int threads) {
    return std::clamp<std::size_t>(splats / std::max<std::size_t>(bins, 1), 1, thread_count(threads));
  }
  std::size_t first_bin(int tile, int band) const {
    const auto t = static_cast<std::size_t>(tile);
    return ((t / columns_ * bands_ + static_cast<std::size_t>(band)) * columns_ + t % columns_) * sheets_ * cells_;
  }
  template <class CellOf, class Visit>
  void visit(const Place& place, CellOf cell, Visit visit) const {
    for (int y = place.y0; y <= place.y1; ++y) {
      for (int x = place.x0; x <= place.x1; ++x) {
        const std::size_t unit = static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
        visit((unit * sheets_ + static_cast<std::size_t>(place.sheet)) * cells_ + cell(place, x, y));
      }
    }
  }

  std::size_t columns_, bands_, sheets_, cells_;
  std::vector<std::uint64_t> start_;    ///< per (row of bands, column of tiles, sheet, cell)
  Uninitialised<std::uint32_t> order_;  ///< splat numbers
};

}  // namespace fastsplat::driver
