// SPDX-License-Identifier: Apache-2.0
// Elliptical footprints: a spherical kernel seen in perspective, by the local affine projection of Zwicker et al. 2001.
// docs/techniques/elliptical-footprints.md
#pragma once

#include <glm/glm.hpp>

#include "scene/camera.hpp"
#include "scene/shaped_splat.hpp"

namespace fastsplat::scene {

/// At the splat, the map (X,Y,Z) -> (f X/Z, f Y/Z) has the derivative J = s (1 0 -gx; 0 1 -gy), with g = (X,Y)/Z the
/// tangents of its direction. A sphere becomes S = J J^T = s^2 (I + g g^T). It is longer by 1/cos(angle) away from the
/// image's centre. Orthographic: g = 0, the circle, bit for bit.
inline void apply_perspective(const Camera& camera, const glm::dvec3& world, double depth, ShapedSplat& splat) {
  const double from_eye = camera.eye_distance() + depth;  // mm; infinite for an orthographic camera
  const double gx = glm::dot(world, camera.right()) / from_eye;
  const double gy = glm::dot(world, camera.down()) / from_eye;
  const ScreenShape circle = splat.shape;
  reshape(splat, {circle.xx * (1.0 + gx * gx), circle.xx * gx * gy, circle.yy * (1.0 + gy * gy)});
}

}  // namespace fastsplat::scene
