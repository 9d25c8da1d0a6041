// SPDX-License-Identifier: Apache-2.0
// Scenes whose densities are a function of position, for classification after splatting.
#pragma once

#include <functional>

#include "golden/render.hpp"
#include "scene/scene.hpp"

namespace fastsplat::golden::testing {

struct DensityScene {
  glm::ivec3 dims{24};
  glm::dvec3 spacing{1.0};
  std::function<double(const glm::dvec3& mm)> density;  ///< at a voxel, 0..1
  std::vector<scene::ControlPoint> points;              ///< by value
  double a = 2.0, radius = 2.0;
  double pixels_per_mm = 4.0;
  int width = 128, height = 128;
  bool shading = false;
  scene::SceneDescription description;  ///< camera, slabs, techniques; the rest is set from above
};

scene::Scene make_scene(const DensityScene& what);

/// An opacity that jumps at `value` from 0 to opaque.
std::vector<scene::ControlPoint> step_at(double value, const glm::dvec3& colour = glm::dvec3(1.0));

/// 1/2 at `radius` mm from the centre, more inside, less outside, over `ramp` mm.
std::function<double(const glm::dvec3&)> ball(double radius, double ramp);

}  // namespace fastsplat::golden::testing
