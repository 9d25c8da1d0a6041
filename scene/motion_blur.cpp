// SPDX-License-Identifier: Apache-2.0
#include "scene/motion_blur.hpp"

#include <cmath>
#include <numbers>

namespace fastsplat::scene {

MotionBlur::MotionBlur(const Motion& motion, const Camera& camera, const Kernel& kernel)
    : none_(motion.none()),
      camera_(camera),
      translate_(motion.translate),
      sin_(std::sin(0.5 * motion.orbit * std::numbers::pi / 180.0)),
      cos_(std::cos(0.5 * motion.orbit * std::numbers::pi / 180.0)),
      per_pixel2_(1.0 / (12.0 * kernel.variance())) {}

/// Screen position of the point at the shutter's opening (end = -1) or closing (+1). As the camera's azimuth increases,
/// the volume appears to turn the other way, anticlockwise from above.
glm::dvec2 MotionBlur::on_screen(const glm::dvec3& world, double end) const {
  const glm::dvec3 moved = world + 0.5 * end * translate_;
  const double sin = end * sin_;
  const ScreenPoint at = camera_.project({cos_ * moved.x - sin * moved.y, sin * moved.x + cos_ * moved.y, moved.z});
  return {at.x, at.y};
}

void MotionBlur::apply(const glm::dvec3& world, ShapedSplat& splat) const {
  if (none_) return;
  const glm::dvec2 way = on_screen(world, 1.0) - on_screen(world, -1.0);
  reshape(splat, {splat.shape.xx + per_pixel2_ * way.x * way.x, splat.shape.xy + per_pixel2_ * way.x * way.y,
                  splat.shape.yy + per_pixel2_ * way.y * way.y});
}

}  // namespace fastsplat::scene
