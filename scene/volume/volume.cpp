// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/volume.hpp"

#include <algorithm>

namespace fastsplat::volume {
namespace {

/// Derivative along one axis; `here` is the voxel, `stride` the distance to its neighbours in memory.
float difference(const float* here, std::size_t stride, int position, int extent, double spacing) {
  if (extent < 2) return 0.0f;
  const bool first = position == 0;
  const bool last = position == extent - 1;
  const float ahead = last ? *here : *(here + stride);
  const float behind = first ? *here : *(here - stride);
  const double distance = (first || last ? 1.0 : 2.0) * spacing;
  return static_cast<float>((static_cast<double>(ahead) - behind) / distance);
}

}  // namespace

double Volume::bounding_radius() const {
  const glm::dvec3 diagonal = glm::dvec3(dims - 1) * spacing;
  if (!oblique) return 0.5 * glm::length(diagonal);
  double longest = 0.0;  // the diagonals of a sheared box differ
  for (const glm::dvec3 sign : {glm::dvec3(1, 1, 1), {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}})
    longest = std::max(longest, glm::length(axes * (sign * diagonal)));
  return 0.5 * longest;
}

glm::vec3 gradient(const Volume& volume, int i, int j, int k) {
  const float* here = &volume.voxels[volume.index(i, j, k)];
  const std::size_t row = static_cast<std::size_t>(volume.dims.x);
  const glm::vec3 along(difference(here, 1, i, volume.dims.x, volume.spacing.x),
                        difference(here, row, j, volume.dims.y, volume.spacing.y),
                        difference(here, row * volume.dims.y, k, volume.dims.z, volume.spacing.z));
  return volume.oblique ? glm::vec3(glm::transpose(volume.across) * glm::dvec3(along)) : along;
}

}  // namespace fastsplat::volume
