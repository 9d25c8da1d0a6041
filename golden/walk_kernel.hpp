// SPDX-License-Identifier: Apache-2.0
// Evaluates kernels along a ray with vector instructions, chosen for the processor at run time (Highway).
#pragma once

#include <cstddef>
#include <span>

#include "golden/ray_profile.hpp"

namespace fastsplat::golden {

/// Largest number of hits per call.
inline constexpr std::size_t kWalkedTogether = 4;

struct WalkShape {
  double a = 0.0, radius = 0.0;  ///< of the kernel
  double shrink = 0.0;           ///< exp(-2 a step^2)
};

/// Adds hits to samples[begin..end). Each sample gets them in the given order, each value and sum rounded as in
/// RayProfile::add, so the bits are the same. Vectors run over hits for the values, over a sample's sums for the sums.
void walk_hits(const WalkShape& shape, std::span<const RayHit> hits, Sums* samples, std::size_t begin, std::size_t end);

}  // namespace fastsplat::golden
