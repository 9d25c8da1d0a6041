// SPDX-License-Identifier: Apache-2.0
// Built-in scenes of 3-D Gaussians: exact, reproducible, of any number.
#pragma once

#include <string>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// The scenes are `shells` (three spheres of flat Gaussians, the outer ones with holes, degree 3), `cloud` (Gaussians
/// of all shapes and sizes about a point, degree 1) and `outdoor` (outdoor_gaussians.hpp, degree 3). Use "name",
/// "name:count", 1..10,000,000, or, but for `shells`, "name:count:seed". z is up.
GaussianCloud make_synthetic_gaussians(const std::string& name);
/// Whether the word before a colon is one of the names.
bool is_synthetic_gaussians(const std::string& name);
std::vector<std::string> synthetic_gaussian_names();

}  // namespace fastsplat::scene
