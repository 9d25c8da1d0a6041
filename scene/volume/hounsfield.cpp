// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/hounsfield.hpp"

namespace fastsplat::volume {
namespace {

/// Share of soft tissue among the voxels above air; 0 without such voxels.
double share_of_tissue(const Volume& volume, double water) {
  constexpr double kFat = -200.0, kMuscle = 300.0;
  std::size_t above_air = 0, tissue = 0;
  for (const float voxel : volume.voxels) {
    const double hu = voxel - water;
    above_air += hu > kAirHu ? 1 : 0;
    tissue += hu >= kFat && hu <= kMuscle ? 1 : 0;
  }
  return above_air > 0 ? static_cast<double>(tissue) / static_cast<double>(above_air) : 0.0;
}

}  // namespace

std::optional<double> find_water(const Volume& volume) {
  constexpr double kSigned = 0.0, kStoredOffset = 1024.0;
  if (volume.min <= -500.0f && share_of_tissue(volume, kSigned) >= 0.1) return kSigned;
  if (volume.min >= 0.0f && volume.max >= 1500.0f && share_of_tissue(volume, kStoredOffset) >= 0.5)
    return kStoredOffset;
  return std::nullopt;
}

}  // namespace fastsplat::volume
