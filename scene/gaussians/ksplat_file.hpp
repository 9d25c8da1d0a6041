// SPDX-License-Identifier: Apache-2.0
// .ksplat of GaussianSplats3D, version 0.1: sections of Gaussians, as floats or relative to buckets.
#pragma once

#include <string>
#include <string_view>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// Version 0.x, sections and Gaussians within their declared maxima, level of compression 0 to 2.
bool is_ksplat(std::string_view head);

/// Fills `to`, whose source names the file. UserError (Input) for sections that the file is too short for, or whose
/// buckets do not hold their Gaussians.
void read_ksplat(const std::string& bytes, GaussianCloud& to);

}  // namespace fastsplat::scene
