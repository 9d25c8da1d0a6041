// SPDX-License-Identifier: Apache-2.0
// Summed-area table (Crow 1984): the sum over any rectangle of pixels from its four corners, in exact integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fastsplat::golden {

/// Pixels [left, right) x [top, bottom).
struct Window {
  int left = 0, top = 0, right = 0, bottom = 0;

  bool empty() const { return left >= right || top >= bottom; }
  std::uint64_t area() const {
    return empty() ? 0 : static_cast<std::uint64_t>(right - left) * static_cast<std::uint64_t>(bottom - top);
  }
};

/// S(x,y) = v(x,y) + S(x-1,y) + S(x,y-1) - S(x-1,y-1), modulo 2^32. Differences of entries are exact if the sum itself
/// is below 2^32, whatever the size of the image.
class SummedAreaTable {
 public:
  /// All values 0.
  SummedAreaTable(int width, int height);

  /// Replaces the values, row by row. Rows above `first_row` must be unchanged since the last call.
  void rebuild(std::span<const std::uint8_t> values, int first_row);

  /// Sum over a window inside the image, modulo 2^32.
  std::uint32_t sum(const Window& window) const {
    return at(window.right, window.bottom) - at(window.left, window.bottom) - at(window.right, window.top) +
           at(window.left, window.top);
  }

 private:
  /// Sum of all values left of x and above y.
  std::uint32_t at(int x, int y) const { return sums_[static_cast<std::size_t>(y) * stride_ + x]; }

  std::size_t stride_;
  int height_;
  std::vector<std::uint32_t> sums_;
};

}  // namespace fastsplat::golden
