// SPDX-License-Identifier: Apache-2.0
// Files of cameras are read or refused. What is read sees Gaussians at finite pixels, with finite shapes.
#include <cmath>
#include <memory>

#include "scene/gaussians/placed_camera.hpp"
#include "scene/gaussians/projected_gaussian.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  static const auto cloud = std::make_shared<const scene::GaussianCloud>(scene::make_synthetic_gaussians("cloud:20"));
  fuzz::Bytes bytes{data, size};
  const bool sized = fuzz::take_byte(bytes) % 2 != 0;
  const auto path = fuzz::file_of(bytes, ".json");
  fuzz::answered([&] {
    const auto file = scene::load_cameras(path, sized ? std::optional(glm::ivec2(64, 48)) : std::nullopt);
    if (file.cameras.empty()) fuzz::finding("no cameras");
    for (const scene::PlacedCamera& camera : file.cameras) {
      scene::GaussianDescription description;
      description.placed = camera;
      description.width = camera.intrinsics.value().width, description.height = camera.intrinsics->height;
      const scene::GaussianScene scene = scene::build_gaussian_scene(description, cloud);
      for (const scene::ProjectedGaussian& one : scene::project_all(scene)) {
        if (!std::isfinite(one.x + one.y + one.depth + one.shape.xx + one.shape.xy + one.shape.yy))
          fuzz::finding("a Gaussian that is nowhere");
      }
    }
  });
  return 0;
}
