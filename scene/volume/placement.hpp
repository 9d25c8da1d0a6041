// How the axes of a file's grid lie in a body, and how a volume is turned to lie that way.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

/// What a header says; mm, +x right, +y anterior, +z superior. No direction is 0, and they span space.
struct Placement {
  std::array<glm::dvec3, 3> direction;  ///< of the file's axes, any length
  glm::dvec3 origin{0.0};               ///< of the first voxel
  bool has_origin = true;
};

/// Nothing where three vectors do not span space or are no numbers.
bool spans_space(const std::array<glm::dvec3, 3>& direction);

/// Turns whole axes of `volume`, which is in the file's axes, so that its x, y and z run as nearly to the right, to the
/// front and upwards as they can; what is left is Volume::axes. Angles below 0.006 degrees are taken for none. Voxels
/// may be missing.
void place(Volume& volume, const Placement& placement);

/// Degrees by which the axes are turned, and about what; shear: how far two of them are at most from a right angle.
struct Turn {
  double degrees = 0.0;
  glm::dvec3 about{0.0, 0.0, 1.0};
  double shear = 0.0;
};
Turn turn_of(const Volume& volume);

}  // namespace fastsplat::volume
