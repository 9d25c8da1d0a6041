// SPDX-License-Identifier: Apache-2.0
// Palettes of the error maps.
#pragma once

#include "analysis/canvas.hpp"

namespace fastsplat::analysis {

/// -1 deep blue, 0 light grey, +1 deep red, lightness falling evenly to both sides; clamped.
Colour diverging_colour(double position);
/// 0 black, 1 pale yellow, lightness rising steadily; clamped.
Colour heat_colour(double position);
/// For values that are not finite: in neither palette.
constexpr Colour kNonfiniteColour{255, 0, 255};

}  // namespace fastsplat::analysis
