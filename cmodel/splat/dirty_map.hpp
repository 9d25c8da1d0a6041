// SPDX-License-Identifier: Apache-2.0
// The P x P blocks of a sheet that windows meet: geometry only, no sums (M-walk-1).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace fastsplat::cmodel {

class DirtyMap {
 public:
  /// `lanes` is a power of two.
  explicit DirtyMap(int lanes) : lanes_(lanes), lane_bits_(std::countr_zero(static_cast<unsigned>(lanes))) {}

  void begin_tile(int width, int height) {
    width_ = width;
    height_ = height;
    words_ = ((width + lanes_ - 1) / lanes_ + 63) / 64;
    rows_ = (height + lanes_ - 1) / lanes_;
    marks_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(words_), 0);
  }

  /// Marks the blocks that a footprint of width x height pixels from pixel (x,y) on meets inside the tile.
  void mark(std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height) {
    const std::int32_t x0 = std::max(0, x), x1 = std::min(width_, x + width);
    const std::int32_t y0 = std::max(0, y), y1 = std::min(height_, y + height);
    if (x0 >= x1 || y0 >= y1) return;
    const int first = x0 >> lane_bits_, last = (x1 - 1) >> lane_bits_;
    for (int row = y0 >> lane_bits_; row <= (y1 - 1) >> lane_bits_; ++row) {
      std::uint64_t* words = &marks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(words_)];
      for (int word = first >> 6; word <= last >> 6; ++word) {
        const int low = std::max(first - 64 * word, 0), high = std::min(last - 64 * word, 63);
        words[word] |= (~std::uint64_t{0} >> (63 - high)) & (~std::uint64_t{0} << low);
      }
    }
  }

  std::uint64_t count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : marks_) sum += static_cast<std::uint64_t>(std::popcount(word));
    return sum;
  }

  /// Calls visit(block column, block row) for every marked block, row by row.
  template <class Visit>
  void each(Visit visit) const {
    for (int row = 0; row < rows_; ++row) {
      for (int word = 0; word < words_; ++word) {
        auto left =
            marks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(words_) + static_cast<std::size_t>(word)];
        for (; left != 0; left &= left - 1) visit(64 * word + std::countr_zero(left), row);
      }
    }
  }

  void clear() { std::fill(marks_.begin(), marks_.end(), 0); }

 private:
  int lanes_, lane_bits_;
  int width_ = 0, height_ = 0, rows_ = 0, words_ = 0;
  std::vector<std::uint64_t> marks_;
};

}  // namespace fastsplat::cmodel
