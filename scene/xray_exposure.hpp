// SPDX-License-Identifier: Apache-2.0
// The automatic exposure of X-rays (docs/numerics.md, N-8-23). It depends on the volume, not on the view, so that a
// turning volume keeps its brightness.
#pragma once

#include "scene/transfer_function.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::scene {

/// Largest sum of extinctions along a line of voxels, times the step from one to the next in kernel units: the lines
/// along the 13 directions to a voxel's 26 neighbours. An estimate of the brightest ray of any view: exact along those
/// directions; a thin rod between two of them, seen end-on, can be brighter. 0: nothing visible.
double densest_line(const volume::Volume& volume, const Classifier& classify);

/// 1 / (opacity_scale times the densest line, ripple of the kernel included); 1 where nothing is visible.
double automatic_exposure(const volume::Volume& volume, const Classifier& classify, double opacity_scale);

}  // namespace fastsplat::scene
