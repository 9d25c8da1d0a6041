// SPDX-License-Identifier: Apache-2.0
// The shape of a splat's kernel on the screen: an ellipse of the same energy.
#pragma once

#include <array>
#include <cmath>

namespace fastsplat::scene {

/// The image of the kernel's unit disc: the ellipse d^T S^-1 d < 1, S in square pixels, positive
/// definite. A footprint's second moments are Kernel::variance() * S, so blurs add to S.
struct ScreenShape {
  double xx = 0.0, xy = 0.0, yy = 0.0;

  double determinant() const { return xx * yy - xy * xy; }
};

struct ShapedSplat {
  ScreenShape shape;
  double depth_growth = 1.0;      ///< factor on the kernel's extent along z
  std::array<double, 4> value{};  ///< times the footprint of its shape: the whole splat's contribution to a pixel
};

/// Gives the splat another shape and keeps its energy.
inline void reshape(ShapedSplat& splat, const ScreenShape& shape) {
  const double amplitude = std::sqrt(splat.shape.determinant() / shape.determinant());  // exactly 1 for the same shape
  for (double& value : splat.value) value *= amplitude;
  splat.shape = shape;
}

}  // namespace fastsplat::scene
