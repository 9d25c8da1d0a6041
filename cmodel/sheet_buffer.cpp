#include "cmodel/sheet_buffer.hpp"

#include <algorithm>

#include "cmodel/narrow.hpp"

namespace fastsplat::cmodel {

SheetBuffer::SheetBuffer(const Config& config)
    : format_(config.sheet_format()),
      product_frac_bits_(config.colour_frac_bits + config.radial_frac_bits),
      lanes_(config.lanes),
      lane_bits_(Config::log2_exact(config.lanes)) {}

void SheetBuffer::begin_tile(int width, int height) {
  width_ = width;
  height_ = height;
  blocks_x_ = (width + lanes_ - 1) / lanes_;
  blocks_y_ = (height + lanes_ - 1) / lanes_;
  words_.assign(static_cast<std::size_t>(width) * height, SheetWord{});
  dirty_.assign(static_cast<std::size_t>(blocks_x_) * blocks_y_, 0);
}

void SheetBuffer::accumulate(std::int32_t x, std::int32_t y, std::span<const std::uint32_t> weights,
                             const std::array<std::uint32_t, 4>& colour, Counters& counters) {
  const int first_column = std::max(0, -x), last_column = std::min(lanes_, width_ - x);
  const int first_row = std::max(0, -y), last_row = std::min(lanes_, height_ - y);
  if (first_column >= last_column || first_row >= last_row) return;
  counters.lanes_inside += static_cast<std::uint64_t>(last_column - first_column) * (last_row - first_row);

  for (int by = (y + first_row) >> lane_bits_; by <= (y + last_row - 1) >> lane_bits_; ++by) {
    for (int bx = (x + first_column) >> lane_bits_; bx <= (x + last_column - 1) >> lane_bits_; ++bx) {
      dirty_[static_cast<std::size_t>(by) * blocks_x_ + bx] = 1;
    }
  }
  std::uint64_t weighted = 0, product_saturated = 0, sheet_saturated = 0;
  for (int j = first_row; j < last_row; ++j) {
    SheetWord* row = &words_[index(x + first_column, y + j)];
    for (int i = first_column; i < last_column; ++i, ++row) {
      const std::int64_t weight = weights[static_cast<std::size_t>(j) * lanes_ + i];
      if (weight == 0) continue;
      ++weighted;
      for (std::size_t c = 0; c < 4; ++c) {
        const Narrowed product = narrow<Rounding::RND, Overflow::SAT>(colour[c] * weight, product_frac_bits_, format_);
        const Narrowed sum = narrow<Rounding::TRN, Overflow::SAT>((*row)[c] + product.word, format_.frac_bits, format_);
        (*row)[c] = static_cast<std::uint32_t>(sum.word);
        product_saturated += product.overflow ? 1 : 0;
        sheet_saturated += sum.overflow ? 1 : 0;
      }
    }
  }
  counters.lanes_weighted += weighted;
  counters.product_saturated += product_saturated;
  counters.sheet_saturated += sheet_saturated;
}

void SheetBuffer::clear_block(int bx, int by) {
  const int x0 = bx * lanes_, x1 = std::min(width_, x0 + lanes_);
  const int y1 = std::min(height_, (by + 1) * lanes_);
  for (int y = by * lanes_; y < y1; ++y)
    std::fill(&words_[index(x0, y)], &words_[index(x0, y)] + (x1 - x0), SheetWord{});
}

}  // namespace fastsplat::cmodel
