// SPDX-License-Identifier: Apache-2.0
// The built-in scene `outdoor`: as many Gaussians as trained scenes have, with like statistics.
#pragma once

#include <cstdint>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// Appends `count` Gaussians of degree 3: 30 % ground, 55 % surfaces of 40 objects, 15 % sky dome, in random order.
/// Statistics and their sources: docs/techniques/gaussians.md, "A scene as large as trained ones". z is up, the ground
/// is z = 0, and no object stands between 4.5 and 7 from the z axis, where cameras belong.
void append_outdoor(int count, std::uint64_t seed, GaussianCloud& cloud);

}  // namespace fastsplat::scene
