// A disc as a filter of pixels: what a lens makes of a point out of focus.
#pragma once

#include <vector>

namespace fastsplat::golden {

/// Weights w(dx, dy) on the pixels around, symmetric, adding up to 1: each pixel's share of a disc's area. The disc's
/// radius is chosen so that the weights' second moment along either axis is exactly the disc's, diameter^2 / 16: it
/// compensates the sampling in squares, also below a pixel. Diameter 0 is the identity.
class DiscFilter {
 public:
  /// Pixels, >= 0.
  explicit DiscFilter(double diameter);

  int reach() const { return reach_; }  ///< w is 0 where |dx| or |dy| is larger
  /// w(0..reach, dy), to be mirrored.
  const double* half_row(int dy) const { return &weights_[static_cast<std::size_t>(dy < 0 ? -dy : dy) * (reach_ + 1)]; }
  /// The largest |dx| of a row with any weight.
  int row_reach(int dy) const { return row_reach_[static_cast<std::size_t>(dy < 0 ? -dy : dy)]; }

 private:
  void fill(double radius);
  double second_moment() const;

  int reach_ = 0;
  std::vector<double> weights_;  ///< one quadrant, row by row
  std::vector<int> row_reach_;
};

}  // namespace fastsplat::golden
