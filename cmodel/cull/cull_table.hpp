// SPDX-License-Identifier: Apache-2.0
// Opaque cells of a tile as a summed-area table: four words decide whether a rectangle is hidden (N-6.1-5 to N-6.1-7).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace fastsplat::cmodel {

/// Pixels relative to the tile: columns x0..x1-1, rows y0..y1-1.
struct PixelBox {
  std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool empty() const { return x0 >= x1 || y0 >= y1; }
  /// The part inside a tile of width x height pixels.
  PixelBox clipped(int width, int height) const {
    return {std::max<std::int64_t>(x0, 0), std::max<std::int64_t>(y0, 0), std::min<std::int64_t>(x1, width),
            std::min<std::int64_t>(y1, height)};
  }
  bool contains(const PixelBox& other) const {
    return x0 <= other.x0 && y0 <= other.y0 && other.x1 <= x1 && other.y1 <= y1;
  }
};

class CullTable {
 public:
  /// Cells of `cell` x `cell` pixels, a power of two. Words count modulo 2^b, enough for a tile of this size.
  CullTable(int tile_width, int tile_height, int cell)
      : cell_bits_(std::countr_zero(static_cast<unsigned>(cell))),
        mask_((std::uint32_t{1} << std::bit_width(static_cast<unsigned>(cells(tile_width) * cells(tile_height)))) - 1) {
  }

  /// Begins a tile without an opaque cell.
  void begin_tile(int width, int height) {
    width_ = width;
    height_ = height;
    row_ = static_cast<std::size_t>(cells(width)) + 1;
    words_.assign(row_ * (static_cast<std::size_t>(cells(height)) + 1), 0);
  }
  int columns() const { return cells(width_); }
  int rows() const { return cells(height_); }

  /// Rebuilds the rows of cells from `first` on with opaque(column, row). Rows before must not have changed.
  template <class Opaque>
  void build(int first, Opaque opaque) {
    for (int y = first; y < rows(); ++y) {
      const std::uint32_t* above = &words_[static_cast<std::size_t>(y) * row_];
      std::uint32_t* word = &words_[(static_cast<std::size_t>(y) + 1) * row_];
      std::uint32_t count = 0;  // opaque cells of the row
      for (int x = 0; x < columns(); ++x) {
        count += opaque(x, y) ? 1 : 0;
        word[x + 1] = (above[x + 1] + count) & mask_;
      }
    }
  }

  /// Whether all cells that the rectangle meets inside the tile are opaque; true if it meets none.
  bool hidden(const PixelBox& box) const {
    const PixelBox in = box.clipped(width_, height_);
    if (in.empty()) return true;
    const auto [opaque, all] = opaque_cells(in);
    return opaque == all;
  }

  /// Whether the rectangle, inside the tile, meets no opaque cell.
  bool seen(const PixelBox& box) const { return opaque_cells(box).first == 0; }
  /// The part of a rectangle inside the tile.
  PixelBox inside(const PixelBox& box) const { return box.clipped(width_, height_); }

  std::uint32_t word(int i, int j) const {
    return words_[static_cast<std::size_t>(j) * row_ + static_cast<std::size_t>(i)];
  }
  std::uint32_t largest_word() const { return mask_; }  ///< 2^b - 1

 private:
  /// Opaque cells, and all cells, that a rectangle inside the tile meets, as words.
  std::pair<std::uint32_t, std::uint32_t> opaque_cells(const PixelBox& in) const {
    const auto i0 = static_cast<std::size_t>(in.x0) >> cell_bits_, j0 = static_cast<std::size_t>(in.y0) >> cell_bits_;
    const auto i1 = static_cast<std::size_t>(cells(static_cast<int>(in.x1))),
               j1 = static_cast<std::size_t>(cells(static_cast<int>(in.y1)));
    const std::uint32_t count =
        words_[j1 * row_ + i1] - words_[j1 * row_ + i0] - words_[j0 * row_ + i1] + words_[j0 * row_ + i0];
    return {count & mask_, static_cast<std::uint32_t>((i1 - i0) * (j1 - j0)) & mask_};
  }
  int cells(int pixels) const { return (pixels + (1 << cell_bits_) - 1) >> cell_bits_; }

  int cell_bits_;
  std::uint32_t mask_;
  int width_ = 0, height_ = 0;
  std::size_t row_ = 0;  ///< words of a row
  std::vector<std::uint32_t> words_;
};

}  // namespace fastsplat::cmodel
