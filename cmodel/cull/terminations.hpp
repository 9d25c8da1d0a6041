// SPDX-License-Identifier: Apache-2.0
// After which sheet each pixel of a picture is terminated: all that cull tests depend on (M-cull-2).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace fastsplat::cmodel {

struct Terminations {
  static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

  int width = 0;
  std::vector<std::uint32_t> sheets{};  ///< row by row; kNever for pixels that stay open

  Terminations(int across, int down)
      : width(across), sheets(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), kNever) {}
  std::uint32_t at(int x, int y) const { return sheets[index(x, y)]; }
  /// The first sheet noted for a pixel stays.
  void note(int x, int y, std::uint32_t sheet) { sheets[index(x, y)] = std::min(sheets[index(x, y)], sheet); }
  /// The pixels of a rectangle are open again.
  void reset(int x, int y, int across, int down) {
    for (int row = y; row < y + down; ++row)
      std::fill_n(sheets.begin() + static_cast<std::ptrdiff_t>(index(x, row)), across, kNever);
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace fastsplat::cmodel
