// SPDX-License-Identifier: Apache-2.0
// Shapes a splat on the screen: a pipeline in which each technique changes the shape of the previous one.
//
//   circle -> ellipse (perspective) -> growth (anti-aliasing) -> + motion -> + lens
//
// Each stage exists only if its setting is on, and keeps every bit where it has no effect.
#pragma once

#include "scene/depth_of_field_splats.hpp"
#include "scene/motion_blur.hpp"
#include "scene/real_splat.hpp"
#include "scene/scene.hpp"
#include "scene/shaped_splat.hpp"
#include "scene/splats.hpp"

namespace fastsplat::scene {

class SplatShaper {
 public:
  /// The scene must outlive this object.
  explicit SplatShaper(const Scene& scene);
  /// Shapes a splat that adds `value` to a pixel as a circle of its own scale. `real` is the projected splat.
  ShapedSplat operator()(const Splat& splat, const RealSplat& real, const std::array<double, 4>& value) const;

 private:
  const Scene& scene_;
  double unit_;
  MotionBlur motion_;
  DepthOfFieldSplats lens_;
};

}  // namespace fastsplat::scene
