// SPDX-License-Identifier: Apache-2.0
// The edge of an ellipse given by its words, row by row (docs/numerics.md, N-8-31 and N-8-32).
#pragma once

#include <algorithm>
#include <cmath>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::driver {

/// The edge q = N 2^g in units of A dx^2, dx in 2^-pf pixel.
inline double rim_of(const cmodel::Config& config, const cmodel::EllipseShape& shape) {
  return std::ldexp(static_cast<double>(config.rlut_rim()), static_cast<int>(shape.shift));
}
/// 4 A C - B^2, exact.
inline double determinant(const cmodel::EllipseShape& shape) {
  return 4.0 * static_cast<double>(shape.a) * static_cast<double>(shape.c) -
         static_cast<double>(shape.b) * static_cast<double>(shape.b);
}

/// A footprint's edge row by row, in 2^-pf pixel from the centre.
class Rim {
 public:
  Rim(const cmodel::Config& config, const cmodel::EllipseShape& shape)
      : a_(shape.a), b_(shape.b), c_(shape.c), rim_(rim_of(config, shape)), determinant_(determinant(shape)) {
    half_height_ = std::sqrt(4.0 * a_ * rim_ / determinant_);
    rightmost_ = -b_ * std::sqrt(4.0 * c_ * rim_ / determinant_) / (2.0 * c_);
  }
  double half_height() const { return half_height_; }
  /// The farthest points of the rows [from, to] to the right and to the left.
  double right(double from, double to) const { return middle(std::clamp(rightmost_, from, to), 1.0); }
  double left(double from, double to) const { return middle(std::clamp(-rightmost_, from, to), -1.0); }

 private:
  double middle(double y, double side) const {
    const double square = (rim_ - y * y * (determinant_ / (4.0 * a_))) / a_;
    return -b_ * y / (2.0 * a_) + side * std::sqrt(std::max(square, 0.0));
  }
  double a_, b_, c_, rim_, determinant_;
  double half_height_ = 0.0;
  double rightmost_ = 0.0;  ///< the row in which it is widest to the right
};

}  // namespace fastsplat::driver
