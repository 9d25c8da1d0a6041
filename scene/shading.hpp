// SPDX-License-Identifier: Apache-2.0
// Shading: Phong with a light that travels with the camera, for voxels and for pixels.
#pragma once

#include <glm/glm.hpp>

#include "scene/camera.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::scene {

/// What shading needs of a point and does not depend on the view.
struct Surface {
  glm::vec3 normal{0.0f};
  float share = 0.0f;  ///< of the shaded colour in the result, 0: the colour as classified
};

/// Shades a colour by a gradient; a voxel's is its central difference. The light is directional, slightly above and to
/// the left of the view axis; surfaces are lit from both sides. If the gradient is weaker than Shading::gradient_floor
/// the colour stays as classified; up to twice the floor shading is blended in.
class Shader {
 public:
  Shader(const Shading& shading, const Camera& camera, const volume::Volume& volume);

  const glm::vec3& light() const { return light_; }  ///< world, unit, towards the light
  const glm::vec3& half() const { return half_; }    ///< world, unit, between light and eye
  /// The surface at a voxel; at a gradient in value per mm, world.
  Surface surface(int i, int j, int k) const { return surface(gradient(volume_, i, j, k)); }
  Surface surface(const glm::vec3& slope) const;
  /// Every channel of the result is in [0,1].
  glm::vec3 operator()(const glm::vec3& colour, const Surface& surface) const;
  glm::vec3 operator()(const glm::vec3& colour, const glm::vec3& slope) const {
    return (*this)(colour, surface(slope));
  }

 private:
  Shading shading_;
  const volume::Volume& volume_;
  glm::vec3 light_;  // unit, towards the light
  glm::vec3 half_;   // unit, between light and eye
  float floor_;      // value per mm
};

}  // namespace fastsplat::scene
