// SPDX-License-Identifier: Apache-2.0
// Colour as seen from a direction: real spherical harmonics to degree 3.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// Y_0^0, the constant one.
inline constexpr double kConstantHarmonic = 0.28209479177387814;

/// The 16 real harmonics of a unit direction, with the Condon-Shortley phase, by degree and then from order -l to l:
/// the basis of trainers' coefficients (Kerbl et al. 2023; Sloan, "Stupid Spherical Harmonics Tricks", 2008).
std::array<double, 16> harmonics_at(const glm::dvec3& direction);

/// 1/2 + the sum of coefficients times harmonics, not below 0. `coefficients`: 1, 4, 9 or 16.
glm::dvec3 colour_at(std::span<const glm::vec3> coefficients, const glm::dvec3& direction);

}  // namespace fastsplat::scene
