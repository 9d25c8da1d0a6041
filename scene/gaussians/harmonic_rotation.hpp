// SPDX-License-Identifier: Apache-2.0
// Spherical harmonics of a scene that is turned.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

namespace fastsplat::scene {

/// Turns coefficients with the scene: colour_at(turned, R d) is colour_at(coefficients, d) for every direction d.
class HarmonicRotation {
 public:
  /// `turn`: a rotation.
  explicit HarmonicRotation(const glm::dmat3& turn);
  /// `coefficients`: 1, 4, 9 or 16.
  void apply(std::span<glm::vec3> coefficients) const;

 private:
  std::array<std::array<double, 16>, 16> matrix_{};  ///< a block for each degree
};

}  // namespace fastsplat::scene
