// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/hounsfield.hpp"

namespace fastsplat::volume {
namespace {

constexpr double kFat = -200.0, kMuscle = 300.0;

/// Shares of voxels if 0 HU is `water`. The least value may be padding and is not counted.
struct Shares {
  double tissue = 0.0;     ///< soft tissue, of the voxels above air
  double below_air = 0.0;  ///< of all voxels
};

Shares shares_of(const Volume& volume, double water) {
  constexpr double kLeastAir = -1100.0;  // HU, with the noise of a scanner
  std::size_t above_air = 0, tissue = 0, below = 0;
  for (const float voxel : volume.voxels) {
    if (voxel == volume.min) continue;
    const double hu = voxel - water;
    above_air += hu > kAirHu ? 1 : 0;
    tissue += hu >= kFat && hu <= kMuscle ? 1 : 0;
    below += hu < kLeastAir ? 1 : 0;
  }
  return {.tissue = above_air > 0 ? static_cast<double>(tissue) / static_cast<double>(above_air) : 0.0,
          .below_air = static_cast<double>(below) / static_cast<double>(volume.voxels.size())};
}

}  // namespace

std::optional<double> find_water(const Volume& volume) {
  constexpr double kSigned = 0.0, kStoredOffset = 1024.0, kFew = 0.01;
  if (volume.max >= 1500.0f) {
    const Shares stored = shares_of(volume, kStoredOffset);
    if (stored.tissue >= 0.5 && stored.below_air <= kFew) return kStoredOffset;
  }
  if (volume.min > -500.0f) return std::nullopt;
  const Shares plain = shares_of(volume, kSigned);
  return plain.tissue >= 0.1 && plain.below_air <= kFew ? std::optional(kSigned) : std::nullopt;
}

}  // namespace fastsplat::volume
