// SPDX-License-Identifier: Apache-2.0
// A projected splat: the place and shape of its footprint on the screen, and what it adds.
#pragma once

#include "scene/shaped_splat.hpp"

namespace fastsplat::scene {
class TexturePhase;
}

namespace fastsplat::golden {

/// Sums that a sheet gathers per pixel: red, green, blue (premultiplied emission) and optical depth.
using Sums = std::array<double, 4>;

inline Sums scaled(const Sums& value, double share) {
  return {value[0] * share, value[1] * share, value[2] * share, value[3] * share};
}

/// `value` is to be multiplied by Kernel::footprint().
struct ProjectedSplat : scene::ShapedSplat {
  double x = 0.0, y = 0.0;                       ///< pixels; pixel centres are at integers
  double z = 0.0;                                ///< depth of the centre, kernel units
  double reach_x = 0.0, reach_y = 0.0;           ///< pixels; the footprint's support is strictly inside
  int sheet = 0;                                 ///< axis-aligned sheet
  const scene::TexturePhase* texture = nullptr;  ///< owned by the Projector; null for a plain splat
  double texture_amplitude = 0.0;
};

}  // namespace fastsplat::golden
