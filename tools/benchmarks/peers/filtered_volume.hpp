// SPDX-License-Identifier: Apache-2.0
// The density field that splats reconstruct, as a finer volume, so that another renderer draws the same field.
#pragma once

#include "scene/kernel.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::bench {

/// base + sum over v of (f_v - base) h(x - v), with base the least value (docs/techniques/post-classified.md). It has
/// `finer` points per voxel along each axis and extends as far as the kernel reaches; floats, centred as the volume,
/// not oblique. The kernel ends on a cube along the axes, not on a splat's cylinder along the view: less than 2 exp(-a
/// R^2) of its weight lies in only one of them.
volume::Volume filtered(const volume::Volume& volume, const scene::Kernel& kernel, int finer);

}  // namespace fastsplat::bench
