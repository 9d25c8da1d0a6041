// SPDX-License-Identifier: Apache-2.0
// Formats differ in which axes point right, up and forward. A cloud has the axes of PLY files: x right, y down, z
// forward. Flipping an axis changes only signs, so it is exact.
#pragma once

#include <span>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

inline const glm::vec3 kFlipsOfRub{1.0F, -1.0F, -1.0F};  ///< x right, y up, z back: SPZ
inline const glm::vec3 kFlipsOfLuf{-1.0F, -1.0F, 1.0F};  ///< x left, y up, z forward: glTF

/// Changes the axes of a Gaussian by `flips`, each 1 or -1. `rotation`: w, x, y, z of any length; it and `harmonics`
/// belong to the Gaussian. Its own inverse.
void flip_axes(const glm::vec3& flips, glm::vec3& position, glm::dvec4& rotation, std::span<glm::vec3> harmonics);

}  // namespace fastsplat::scene
