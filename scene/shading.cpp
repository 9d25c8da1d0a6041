// SPDX-License-Identifier: Apache-2.0
#include "scene/shading.hpp"

#include <algorithm>
#include <cmath>

#include "scene/value_range.hpp"

namespace fastsplat::scene {
namespace {

constexpr double kLightLeft = 0.35;  // in units of the distance towards the eye
constexpr double kLightUp = 0.50;

/// Towards the light, in doubles. The half vector uses it unrounded: GCC 12 takes a vector of doubles that was
/// rounded to floats and widened again for the one before.
glm::dvec3 light_of(const Camera& camera) {
  return glm::normalize(-camera.direction() - kLightLeft * camera.right() - kLightUp * camera.down());
}

}  // namespace

Shader::Shader(const Shading& shading, const Camera& camera, const volume::Volume& volume)
    : shading_(shading),
      volume_(volume),
      light_(light_of(camera)),
      half_(glm::normalize(light_of(camera) - camera.direction())),
      floor_(static_cast<float>(shading.gradient_floor * spread(volume) / volume.kernel_unit())) {}

Surface Shader::surface(const glm::vec3& slope) const {
  const float length = glm::length(slope);
  if (!(length > floor_)) return {};
  return {.normal = slope / length, .share = floor_ > 0.0f ? std::min(1.0f, (length - floor_) / floor_) : 1.0f};
}

glm::vec3 Shader::operator()(const glm::vec3& colour, const Surface& surface) const {
  const auto& [normal, share] = surface;
  if (!(share > 0.0f)) return colour;
  const float facing = std::abs(glm::dot(normal, light_));
  const float glint = std::pow(std::abs(glm::dot(normal, half_)), static_cast<float>(shading_.shininess));
  const float matt = static_cast<float>(shading_.ambient) + static_cast<float>(shading_.diffuse) * facing;
  const glm::vec3 lit = colour * matt + static_cast<float>(shading_.specular) * glint;
  return glm::clamp(glm::mix(colour, lit, share), 0.0f, 1.0f);
}

}  // namespace fastsplat::scene
