// SPDX-License-Identifier: Apache-2.0
// After which sheet each pixel of a picture is terminated: all that cull tests depend on (M-cull-2).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace fastsplat::cmodel {

class Terminations {
 public:
  static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

  /// All pixels are open.
  Terminations(int width, int height)
      : width_(static_cast<std::size_t>(width)), sheets_(width_ * static_cast<std::size_t>(height), kNever) {}

  /// kNever for a pixel that stays open.
  std::uint32_t at(int x, int y) const { return sheets_[index(x, y)]; }
  /// The first sheet noted for a pixel stays.
  void note(int x, int y, std::uint32_t sheet) { sheets_[index(x, y)] = std::min(sheets_[index(x, y)], sheet); }
  /// The pixels of a rectangle are open again.
  void reset(int x, int y, int width, int height) {
    for (int row = y; row < y + height; ++row)
      std::fill_n(sheets_.begin() + static_cast<std::ptrdiff_t>(index(x, row)), width, kNever);
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x); }

  std::size_t width_;
  std::vector<std::uint32_t> sheets_;  ///< row by row
};

}  // namespace fastsplat::cmodel
