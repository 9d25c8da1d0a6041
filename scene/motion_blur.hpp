// SPDX-License-Identifier: Apache-2.0
// Motion blur: a footprint stretched along its path over the screen while the shutter is open (Mueller et al. 1998).
// docs/techniques/motion-blur.md
#pragma once

#include <glm/glm.hpp>

#include "scene/camera.hpp"
#include "scene/kernel.hpp"
#include "scene/shaped_splat.hpp"
#include "scene/techniques.hpp"

namespace fastsplat::scene {

class MotionBlur {
 public:
  MotionBlur(const Motion& motion, const Camera& camera, const Kernel& kernel);

  /// A point spread evenly over the straight path u has the second moment u u^T / 12. It is added to the footprint's.
  void apply(const glm::dvec3& world, ShapedSplat& splat) const;

 private:
  glm::dvec2 on_screen(const glm::dvec3& world, double end) const;

  bool none_;
  const Camera& camera_;
  glm::dvec3 translate_;
  double sin_, cos_;  ///< of half the orbit
  double per_pixel2_;
};

}  // namespace fastsplat::scene
