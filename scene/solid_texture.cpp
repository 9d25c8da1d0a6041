// SPDX-License-Identifier: Apache-2.0
#include "scene/solid_texture.hpp"

#include <array>

namespace fastsplat::scene {
namespace {

struct Tints {
  glm::dvec3 at_0, at_1;
};

/// In the order of SolidKind.
constexpr std::array<Tints, 6> kTints{{
    {{1.00, 1.00, 1.00}, {1.00, 1.00, 1.00}},
    {{0.20, 0.20, 0.20}, {1.00, 1.00, 1.00}},
    {{0.28, 0.30, 0.38}, {1.00, 0.99, 0.96}},
    {{0.36, 0.18, 0.08}, {0.96, 0.74, 0.45}},
    {{0.10, 0.10, 0.10}, {1.00, 1.00, 1.00}},
    {{0.15, 0.15, 0.18}, {1.00, 1.00, 1.00}},
}};

}  // namespace

glm::dvec3 tint_of_value(const Texture& texture, double value) {
  const Tints& tints = kTints[static_cast<std::size_t>(texture.kind)];
  const glm::dvec3 colour = tints.at_0 + value * (tints.at_1 - tints.at_0);
  return 1.0 - texture.amplitude * (1.0 - colour);
}

glm::dvec3 tint(const Texture& texture, const glm::dvec3& position) {
  return tint_of_value(texture, solid_field(texture.kind, position / texture.scale));
}

}  // namespace fastsplat::scene
