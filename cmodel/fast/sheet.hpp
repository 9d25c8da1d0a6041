// SPDX-License-Identifier: Apache-2.0
// The fast unit's sheet: a tile's sums with a guard band around, so that no footprint is clipped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "cmodel/splat/lane.hpp"

namespace fastsplat::cmodel::fast {

/// Words of T (16 or 32 bits), four a pixel. The guard band is never read.
template <class T>
class Sheet {
 public:
  /// Resizes to a tile and room for footprints of up to `reach` pixels, wherever they meet it; all words zero.
  void resize(int width, int height, int reach) {
    guard_ = reach;
    row_ = static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(guard_);
    // Rows a multiple of 4 KiB apart would share the same lines of the first-level cache.
    if (row_ * 4 * sizeof(T) % 4096 < 64) row_ += 16;
    words_.assign(row_ * (static_cast<std::size_t>(height) + 2 * static_cast<std::size_t>(guard_)) * 4, 0);
  }
  std::size_t row() const { return row_; }  ///< pixels
  std::size_t at(int x, int y) const {
    return (static_cast<std::size_t>(y + guard_)) * row_ + static_cast<std::size_t>(x + guard_);
  }
  std::size_t pixels() const { return words_.size() / 4; }  ///< including the guard band
  T* words() { return words_.data(); }
  SheetWord sums(int x, int y) const {
    const T* at = words_.data() + this->at(x, y) * 4;
    return {at[0], at[1], at[2], at[3]};
  }
  void clear() { std::ranges::fill(words_, T{0}); }
  void clear(int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y)
      std::memset(words_.data() + at(x0, y) * 4, 0, static_cast<std::size_t>(x1 - x0) * 4 * sizeof(T));
  }

 private:
  int guard_ = 0;
  std::size_t row_ = 0;
  std::vector<T> words_;
};

}  // namespace fastsplat::cmodel::fast
