// SPDX-License-Identifier: Apache-2.0
// Built-in volumes made of noise: a landscape and a fire.
#pragma once

namespace fastsplat::volume {

/// Ground below a fractal height field with a lake in its valleys: 0 in the air, 0..0.5 in the skin of half-covered
/// voxels, above that 0.5 to 1 by height.
float terrain(int i, int j, int k, int n);

/// A flame: hottest inside and below, torn into tongues above; 0 outside.
float fire(int i, int j, int k, int n);

}  // namespace fastsplat::volume
