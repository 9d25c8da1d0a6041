// SPDX-License-Identifier: Apache-2.0
// What the built-in scenes of 3-D Gaussians share: random numbers, rotations, colours.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {

/// splitmix64 (Steele, Lea, Flood 2014). Draws must not be arguments of one call: compilers differ in their order.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Mean 0, deviation 1, nearly normal: the sum of 12 uniform numbers.
  double normal() {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += unit();
    return sum;
  }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

/// Quaternion (w, x, y, z) of the shortest rotation that takes z to `direction`.
inline glm::dvec4 turn_to(const glm::dvec3& direction) {
  const glm::dvec4 q(1.0 + direction.z, -direction.y, direction.x, 0.0);
  const double length = glm::length(q);
  return length < 1e-9 ? glm::dvec4(0.0, 1.0, 0.0, 0.0) : q / length;
}

/// Constant coefficient for a mean colour of 0..1.
inline glm::vec3 constant_of(const glm::dvec3& colour) { return (colour - glm::dvec3(0.5)) / kConstantHarmonic; }

}  // namespace fastsplat::scene
