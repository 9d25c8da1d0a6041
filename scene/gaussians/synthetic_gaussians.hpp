// SPDX-License-Identifier: Apache-2.0
// Built-in scenes of 3-D Gaussians: exact, reproducible, of any number.
#pragma once

#include <string>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// The scenes are `shells` (three spheres of flat Gaussians, the outer ones with holes, degree 3) and `cloud`
/// (Gaussians of all shapes and sizes about a point, degree 1). Use "name" or "name:count", 1..10,000,000. z is up,
/// lengths about 1.
GaussianCloud make_synthetic_gaussians(const std::string& name);
/// Whether the word before a colon is one of the names.
bool is_synthetic_gaussians(const std::string& name);
std::vector<std::string> synthetic_gaussian_names();

}  // namespace fastsplat::scene
