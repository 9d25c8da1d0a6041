// SPDX-License-Identifier: Apache-2.0
// Depth of field by filtering splats: each footprint is widened to its circle of confusion.
// docs/techniques/depth-of-field.md
#pragma once

#include "scene/kernel.hpp"
#include "scene/shaped_splat.hpp"
#include "scene/techniques.hpp"

namespace fastsplat::scene {

class DepthOfFieldSplats {
 public:
  DepthOfFieldSplats(const Lens& lens, const Camera& camera, const Kernel& kernel)
      : lens_(lens), camera_(camera), per_pixel2_(1.0 / (16.0 * kernel.variance())) {}

  /// A point spread evenly over a disc of diameter c has the second moment c^2/16 along each axis (half of the mean
  /// squared radius (c/2)^2/2). It is added to the footprint's.
  void apply(double depth, ShapedSplat& splat) const {
    if (lens_.depth_of_field != DepthOfField::Splats) return;
    const double c = circle_of_confusion(camera_, lens_, depth);
    const double added = per_pixel2_ * c * c;
    reshape(splat, {splat.shape.xx + added, splat.shape.xy, splat.shape.yy + added});
  }

 private:
  const Lens& lens_;
  const Camera& camera_;
  double per_pixel2_;
};

}  // namespace fastsplat::scene
