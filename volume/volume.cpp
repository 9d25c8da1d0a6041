#include "volume/volume.hpp"

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

glm::vec3 gradient(const Volume& volume, int i, int j, int k) {
  const float* here = &volume.voxels[volume.index(i, j, k)];
  const std::size_t row = static_cast<std::size_t>(volume.dims.x);
  return {difference(here, 1, i, volume.dims.x, volume.spacing.x),
          difference(here, row, j, volume.dims.y, volume.spacing.y),
          difference(here, row * volume.dims.y, k, volume.dims.z, volume.spacing.z)};
}

}  // namespace fastsplat::volume
