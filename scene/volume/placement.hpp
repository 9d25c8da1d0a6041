// SPDX-License-Identifier: Apache-2.0
// The orientation of a file's grid in a body, and how to turn a volume accordingly.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

/// Placement from a header; mm, +x right, +y anterior, +z superior. The directions are non-zero and span space.
struct Placement {
  std::array<glm::dvec3, 3> direction;  ///< of the file's axes, any length
  glm::dvec3 origin{0.0};               ///< of the first voxel
  bool has_origin = true;
};

/// Whether the three vectors span space; false also if one is not a number.
bool spans_space(const std::array<glm::dvec3, 3>& direction);

/// Turns whole axes of `volume` from the file's: x, y and z then point as nearly as possible to the right, to the front
/// and upwards. Volume::axes holds the remaining rotation; angles below 0.006 degrees count as 0. Voxels may be
/// missing.
void place(Volume& volume, const Placement& placement);

/// Degrees by which the axes are turned, and the axis; shear: the largest deviation of two of them from a right angle.
struct Turn {
  double degrees = 0.0;
  glm::dvec3 about{0.0, 0.0, 1.0};
  double shear = 0.0;
};
Turn turn_of(const Volume& volume);

}  // namespace fastsplat::volume
