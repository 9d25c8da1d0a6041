// SPDX-License-Identifier: Apache-2.0
// The windows that a tile needs of a footprint that may be larger than the tile (docs/numerics.md, section 8, "3-D
// Gaussians").
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::driver {

/// Reach of a footprint from its centre, pixels: the limit of a record's windows and position.
int gaussian_reach(const cmodel::Config& config);

/// Rows of windows, clipped to the tile and to the reach, each as long as the footprint in that row; adjacent rows in
/// the same columns are merged. `x`, `y`: the centre's words relative to the tile of `width` x `height` pixels. Empty
/// if the footprint meets no pixel of the tile.
std::vector<cmodel::EllipseWindows> gaussian_windows(const cmodel::Config& config, const cmodel::EllipseShape& shape,
                                                     std::int32_t x, std::int32_t y, int width, int height);

}  // namespace fastsplat::driver
