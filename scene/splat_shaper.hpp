// From a splat to its shape on the screen: one pipeline in which every technique changes the shape that the one before
// it left.
//
//   circle -> ellipse (perspective) -> growth (anti-aliasing) -> + motion -> + lens
//
// Each is absent unless its setting asks for it, and leaves every bit alone where it has nothing to do.
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
  /// The scene outlives it.
  explicit SplatShaper(const Scene& scene);
  /// Shapes what adds `value` to a pixel as a circle of the splat's own scale. `real` is where the camera puts it.
  ShapedSplat operator()(const Splat& splat, const RealSplat& real, const std::array<double, 4>& value) const;

 private:
  const Scene& scene_;
  double unit_;
  MotionBlur motion_;
  DepthOfFieldSplats lens_;
};

}  // namespace fastsplat::scene
