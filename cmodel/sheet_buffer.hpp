// Unit "sheet buffer": P x P banks of saturating accumulators with a dirty map (docs/numerics.md, section 5).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/config.hpp"
#include "cmodel/counters.hpp"

namespace fastsplat::cmodel {

/// One pixel's sums, U si.sf: R, G, B, tau.
using SheetWord = std::array<std::uint32_t, 4>;

class SheetBuffer {
 public:
  explicit SheetBuffer(const Config& config);

  /// A new tile of width x height pixels, all zero.
  void begin_tile(int width, int height);

  /// Adds one window's products: first pixel (x,y), tile-relative, weights row by row. Pixels outside the tile are
  /// dropped.
  void accumulate(std::int32_t x, std::int32_t y, std::span<const std::uint32_t> weights,
                  const std::array<std::uint32_t, 4>& colour, Counters& counters);

  const SheetWord& at(int x, int y) const { return words_[index(x, y)]; }
  bool inside(std::int64_t x, std::int64_t y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  /// Visits each dirty P x P block (block coordinates), then clears its words and its mark.
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
  void clear_block(int bx, int by);

  Format format_;
  int product_frac_bits_;
  int lanes_, lane_bits_;
  int width_ = 0, height_ = 0, blocks_x_ = 0, blocks_y_ = 0;
  std::vector<SheetWord> words_;
  std::vector<std::uint8_t> dirty_;
};

}  // namespace fastsplat::cmodel
