// SPDX-License-Identifier: Apache-2.0
#include "density_helper.hpp"

#include <algorithm>

namespace fastsplat::golden::testing {

scene::Scene make_scene(const DensityScene& what) {
  auto volume = std::make_shared<volume::Volume>();
  volume->name = volume->source = "test densities";
  volume->dims = what.dims;
  volume->spacing = what.spacing;
  for (int k = 0; k < what.dims.z; ++k) {
    for (int j = 0; j < what.dims.y; ++j) {
      for (int i = 0; i < what.dims.x; ++i)
        volume->voxels.push_back(static_cast<float>(what.density(volume->position(i, j, k))));
    }
  }
  const auto [low, high] = std::minmax_element(volume->voxels.begin(), volume->voxels.end());
  volume->min = *low;
  volume->max = *high;

  scene::SceneDescription description = what.description;
  description.volume = "test densities";
  description.kernel = "";
  description.kernel_a = what.a;
  description.kernel_radius = what.radius;
  description.width = what.width;
  description.height = what.height;
  description.shading = what.shading ? 1 : 0;
  description.camera.zoom = 1.0;
  const double fit = scene::build_scene(description, volume).camera.project(glm::dvec3(0.0)).scale;
  description.camera.zoom = what.pixels_per_mm / fit;
  scene::Scene scene = scene::build_scene(description, volume);
  scene.transfer_function.domain = scene::Domain::Value;
  scene.transfer_function.reference_length = 1.0;
  scene.transfer_function.points = what.points;
  scene.shading = scene::Shading{};
  scene.shading.on = what.shading;
  return scene;
}

std::vector<scene::ControlPoint> step_at(double value, const glm::dvec3& colour) {
  return {{value, colour, 0.0}, {value, colour, 0.9999}};
}

std::function<double(const glm::dvec3&)> ball(double radius, double ramp) {
  return [=](const glm::dvec3& mm) { return std::clamp(0.5 + (radius - glm::length(mm)) / ramp, 0.0, 1.0); };
}

}  // namespace fastsplat::golden::testing
