// SPDX-License-Identifier: Apache-2.0
// Anti-aliased splatting (Swan et al. 1997, Mueller et al. 1998): beyond the depth where voxels lie closer than pixels,
// the kernel grows with depth. docs/techniques/anti-aliasing.md
#pragma once

#include "scene/kernel_growth.hpp"
#include "scene/shaped_splat.hpp"

namespace fastsplat::scene {

/// h_l(x) = lambda^-3 h(x/lambda): footprint and depth extent grow by lambda; the footprint's amplitude falls as
/// lambda^-2, the thickness of its slices accounts for the third power.
inline void apply_antialias(double pixels_per_unit, ShapedSplat& splat) {
  const double growth = kernel_growth(pixels_per_unit);
  const double area = growth * growth;
  reshape(splat, {splat.shape.xx * area, splat.shape.xy * area, splat.shape.yy * area});
  splat.depth_growth = growth;
}

}  // namespace fastsplat::scene
