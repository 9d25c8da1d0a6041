// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/axis_flips.hpp"

#include <array>
#include <string_view>

namespace fastsplat::scene {

void flip_axes(const glm::vec3& flips, glm::vec3& position, glm::dvec4& rotation, std::span<glm::vec3> harmonics) {
  position *= flips;
  // T R T for T = diag(flips): the axes of the Gaussian flip as well, which changes no covariance.
  const glm::dvec3 signs(flips);
  rotation *= glm::dvec4(1.0, signs.y * signs.z, signs.x * signs.z, signs.x * signs.y);
  // The axes in which each harmonic is odd, in the order of harmonics_at.
  constexpr std::array<std::string_view, 16> kOdd{"", "y", "z",   "x", "xy", "yz", "",  "xz",
                                                  "", "y", "xyz", "y", "z",  "x",  "z", "x"};
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    for (const char axis : kOdd[i]) harmonics[i] *= flips[axis - 'x'];
}

}  // namespace fastsplat::scene
