// SPDX-License-Identifier: Apache-2.0
// Unit "sheet buffer": P x P banks of saturating accumulators with a dirty map (docs/numerics.md, section 5).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/splat/lane.hpp"

namespace fastsplat::cmodel {

class SheetBuffer {
 public:
  explicit SheetBuffer(const Config& config)
      : lane_(config), lanes_(config.lanes), lane_bits_(Config::log2_exact(config.lanes)) {}

  /// Begins a tile of width x height pixels, all zero.
  void begin_tile(int width, int height);

  /// Adds one window's products: first pixel (x,y), tile-relative, weights row by row. Pixels outside the tile are
  /// dropped.
  template <class Observer>
  void accumulate(std::int32_t x, std::int32_t y, std::span<const std::uint32_t> weights,
                  const std::array<std::uint32_t, 4>& colour, Counters& counters, Observer& observer) {
    const int first_column = std::max(0, -x), last_column = std::min(lanes_, width_ - x);
    const int first_row = std::max(0, -y), last_row = std::min(lanes_, height_ - y);
    if (first_column >= last_column || first_row >= last_row) return;
    mark(x + first_column, y + first_row, x + last_column, y + last_row);
    const Lane lane = lane_;
    std::uint64_t weighted = 0;
    for (int j = first_row; j < last_row; ++j) {
      SheetWord* row = &words_[index(x + first_column, y + j)];
      for (int i = first_column; i < last_column; ++i, ++row) {
        const std::uint32_t weight = weights[static_cast<std::size_t>(j) * lanes_ + i];
        if (weight == 0) continue;
        ++weighted;
        for (std::size_t c = 0; c < 4; ++c)
          (*row)[c] = lane.accumulate((*row)[c], lane.product(colour[c], weight, observer), observer);
      }
    }
    counters.lanes_inside += static_cast<std::uint64_t>(last_column - first_column) * (last_row - first_row);
    counters.lanes_weighted += weighted;
  }

  const SheetWord& at(int x, int y) const { return words_[index(x, y)]; }
  bool inside(std::int64_t x, std::int64_t y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  /// Calls visit(bx, by) for each dirty P x P block, then clears its words and its mark.
  template <class Visit>
  void drain(Visit visit) {
    for (int by = 0; by < blocks_y_; ++by) {
      for (int bx = 0; bx < blocks_x_; ++bx) {
        auto& mark = dirty_[static_cast<std::size_t>(by) * blocks_x_ + bx];
        if (mark == 0) continue;
        visit(bx, by);
        clear_block(bx, by);
        mark = 0;
      }
    }
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }
  /// Marks the blocks of pixel columns x0..x1-1 and rows y0..y1-1 dirty.
  void mark(int x0, int y0, int x1, int y1);
  void clear_block(int bx, int by);

  Lane lane_;
  int lanes_, lane_bits_;
  int width_ = 0, height_ = 0, blocks_x_ = 0, blocks_y_ = 0;
  std::vector<SheetWord> words_;
  std::vector<std::uint8_t> dirty_;
};

}  // namespace fastsplat::cmodel
