// SPDX-License-Identifier: Apache-2.0
// Collects voxels as density splats, for classification after reconstruction.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

struct DensityField {
  /// The volume's minimum: the value outside the volume. Splats hold values relative to it.
  double base = 0.0;
  /// `extinction` is value - base, > 0; no emission.
  std::vector<scene::Splat> splats;
  std::size_t skipped = 0;  ///< voxels above the base that cannot affect a pixel
};

/// All voxels that can affect a pixel: those above the base, except in clear bricks. A brick is clear if the
/// reconstructed values stay within base + (1+ripple) * [0, largest - base] around it and the transfer function is
/// transparent there. "Around" is as far as any pixel's density and gradient reach. Skipping clear bricks changes no
/// bit. `skip` = false keeps them.
DensityField collect_densities(const scene::Scene& scene, bool skip = true);

}  // namespace fastsplat::golden
