// SPDX-License-Identifier: Apache-2.0
#include "cmodel/splat/sheet_buffer.hpp"

#include <algorithm>

namespace fastsplat::cmodel {

void SheetBuffer::begin_tile(int width, int height) {
  width_ = width;
  height_ = height;
  blocks_x_ = (width + lanes_ - 1) / lanes_;
  blocks_y_ = (height + lanes_ - 1) / lanes_;
  words_.assign(static_cast<std::size_t>(width) * height, SheetWord{});
  dirty_.assign(static_cast<std::size_t>(blocks_x_) * blocks_y_, 0);
}

void SheetBuffer::mark(int x0, int y0, int x1, int y1) {
  for (int by = y0 >> lane_bits_; by <= (y1 - 1) >> lane_bits_; ++by) {
    for (int bx = x0 >> lane_bits_; bx <= (x1 - 1) >> lane_bits_; ++bx)
      dirty_[static_cast<std::size_t>(by) * blocks_x_ + bx] = 1;
  }
}

void SheetBuffer::clear_block(int bx, int by) {
  const int x0 = bx * lanes_, x1 = std::min(width_, x0 + lanes_);
  const int y1 = std::min(height_, (by + 1) * lanes_);
  for (int y = by * lanes_; y < y1; ++y)
    std::fill(&words_[index(x0, y)], &words_[index(x0, y)] + (x1 - x0), SheetWord{});
}

}  // namespace fastsplat::cmodel
