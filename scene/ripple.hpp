// SPDX-License-Identifier: Apache-2.0
// How far a sum of kernels on a grid is from constant.
#pragma once

#include "scene/kernel.hpp"

namespace fastsplat::scene {

/// Relative bound on how far the sum of kernels on a unit lattice can exceed its mean, along a ray tilted by `tilt`
/// (tangent) against the view axis. It is theta^3 / (share of the Gaussian inside the support) - 1. Here theta = sum
/// over n of exp(-(pi n s)^2 / a), and s is the smallest singular value of the shear.
double ripple_bound(const Kernel& kernel, double tilt);

}  // namespace fastsplat::scene
