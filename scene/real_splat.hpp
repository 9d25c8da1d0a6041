// SPDX-License-Identifier: Apache-2.0
// A projected splat in real numbers, which golden shapes and the driver quantises (docs/numerics.md,
// section 8, "real splats").
#pragma once

#include <array>

#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::scene {

struct RealSplat {
  ScreenPoint at;                    ///< centre: pixels; depth, mm; pixels per mm there
  double depth = 0.0;                ///< at.depth in kernel units
  std::array<double, 4> material{};  ///< emission R, G, B and extinction, per kernel unit
  int sheet = 0;                     ///< grid sheet, 0 nearest to the eye
  glm::vec3 place{};                 ///< position in the volume, mm; selects a textured splat's phase
};

inline RealSplat real_splat(const Scene& scene, const Splat& splat) {
  const ScreenPoint at = scene.camera.project(glm::dvec3(splat.position));
  return {.at = at,
          .depth = at.depth / scene.volume->kernel_unit(),
          .material = {splat.emission.x, splat.emission.y, splat.emission.z, splat.extinction},
          .sheet = splat.sheet,
          .place = splat.position};
}

}  // namespace fastsplat::scene
