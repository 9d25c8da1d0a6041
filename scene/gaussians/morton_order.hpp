// SPDX-License-Identifier: Apache-2.0
// An order in which neighbours in the scene are neighbours in the file.
#pragma once

#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// The Gaussians along a Morton curve through the ranks of their coordinates, so that outliers do not coarsen it. Equal
/// places keep their order.
std::vector<std::size_t> morton_order(const GaussianCloud& cloud);

}  // namespace fastsplat::scene
