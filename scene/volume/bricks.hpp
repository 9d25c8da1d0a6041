// SPDX-License-Identifier: Apache-2.0
// A volume's least and greatest values, brick by brick, so that empty space is not visited.
#pragma once

#include <vector>

#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

struct Brick {
  static constexpr int kSide = 8;  ///< voxels; at the volume's far ends a brick may be smaller
  glm::ivec3 low{0}, high{0};      ///< its voxels, both included
  float least = 0.0f, greatest = 0.0f;
};

std::vector<Brick> bricks_of(const Volume& volume);

}  // namespace fastsplat::volume
