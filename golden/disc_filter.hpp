// SPDX-License-Identifier: Apache-2.0
// A disc as a pixel filter: the image of a point out of focus.
#pragma once

#include <vector>

namespace fastsplat::golden {

/// Weights w(dx, dy) of the surrounding pixels: each pixel's share of a disc's area, symmetric, with sum 1. The disc's
/// radius is chosen so that the weights' second moment along either axis is exactly diameter^2 / 16, as of an ideal
/// disc. This compensates for square pixels, even below one pixel. Diameter 0 is the identity.
class DiscFilter {
 public:
  /// `diameter` is in pixels, >= 0.
  explicit DiscFilter(double diameter);

  int reach() const { return reach_; }  ///< w is 0 where |dx| or |dy| is larger
  /// w(0..reach, dy); the other half mirrors it.
  const double* half_row(int dy) const { return &weights_[static_cast<std::size_t>(dy < 0 ? -dy : dy) * (reach_ + 1)]; }
  /// Largest |dx| of row dy with a weight above 0.
  int row_reach(int dy) const { return row_reach_[static_cast<std::size_t>(dy < 0 ? -dy : dy)]; }

 private:
  void fill(double radius);
  double second_moment() const;

  int reach_ = 0;
  std::vector<double> weights_;  ///< one quadrant, row by row
  std::vector<int> row_reach_;
};

}  // namespace fastsplat::golden
