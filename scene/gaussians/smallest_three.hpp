// SPDX-License-Identifier: Apache-2.0
// A unit rotation as the index of its largest component and the other three, which lie within +-1/sqrt(2). SPZ, SOG and
// compressed PLY store it so; they differ in the order of the components and in how they round.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace fastsplat::scene {

struct SmallestThree {
  int largest = 0;
  std::array<double, 3> others{};  ///< in order, without the largest; signs as if the largest were positive
};

inline SmallestThree smallest_three_of(const glm::dvec4& rotation) {
  SmallestThree out;
  for (int i = 1; i < 4; ++i)
    if (std::abs(rotation[i]) > std::abs(rotation[out.largest])) out.largest = i;
  std::size_t next = 0;
  for (int i = 0; i < 4; ++i)
    if (i != out.largest) out.others[next++] = rotation[out.largest] < 0.0 ? -rotation[i] : rotation[i];
  return out;
}

/// The rotation, of unit length if the three allow it.
inline glm::dvec4 rotation_of(const SmallestThree& code) {
  glm::dvec4 out(0.0);
  double rest = 1.0;
  std::size_t next = 0;
  for (int i = 0; i < 4; ++i) {
    if (i == code.largest) continue;
    out[i] = code.others[next++];
    rest -= out[i] * out[i];
  }
  out[code.largest] = std::sqrt(std::max(rest, 0.0));
  return out;
}

}  // namespace fastsplat::scene
