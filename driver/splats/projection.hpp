// SPDX-License-Identifier: Apache-2.0
// The splats of a scene as the device's numbers.
#pragma once

#include <cstdint>

#include "base/uninitialised.hpp"
#include "driver/splats/splat_quantiser.hpp"

namespace fastsplat::driver {

struct Projected {
  Uninitialised<QuantisedSplat> splats;  ///< in traversal order, without vanished ones
  Uninitialised<SplatEllipse> ellipses;  ///< one for each splat in a frame with ellipses; else empty
  std::uint64_t voxels = 0;        ///< non-empty voxels
  std::uint64_t saturated = 0;     ///< voxels whose colour or optical depth left U 4.cf
  std::uint64_t vanished = 0;      ///< voxels whose words are all 0
  double vanished_share = 0.0;     ///< their share of all colour and opacity; 0 with error diffusion
  bool carried = false;
  std::uint64_t widened = 0;             ///< ellipses that were thinner than kThinnest
  std::uint32_t least_shrink = 1 << 16;  ///< shrink of the deepest kernel (DepthGrowth)
};

/// Throws UserError (Usage) if `reach`, an ellipse's half side in pixels, exceeds the device's limit.
void check_reach(double reach, const cmodel::Config& config);

/// The radius sets that the scene's splats need; each radius has `pictures` sets.
RadiusSets radius_sets(const scene::Scene& scene, const cmodel::Config& config, std::size_t pictures = 1);

/// Every real splat of the scene, quantised. `threads` (0: all cores) never changes the result.
Projected project(const scene::Scene& scene, const SplatQuantiser& quantised, int threads);

}  // namespace fastsplat::driver
