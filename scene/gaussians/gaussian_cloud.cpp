// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gaussian_cloud.hpp"

#include <bit>

#include "base/fnv1a.hpp"

namespace fastsplat::scene {

glm::dmat3 axes_of(const Gaussian& gaussian) {
  const double w = gaussian.rotation[0], x = gaussian.rotation[1], y = gaussian.rotation[2], z = gaussian.rotation[3];
  return {glm::dvec3(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
          glm::dvec3(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
          glm::dvec3(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y))};
}

glm::dmat3 covariance(const Gaussian& gaussian) {
  const glm::dmat3 axes = axes_of(gaussian);
  glm::dmat3 out(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double variance = static_cast<double>(gaussian.scale[axis]) * static_cast<double>(gaussian.scale[axis]);
    out += variance * glm::outerProduct(axes[axis], axes[axis]);
  }
  return out;
}

std::uint64_t content_hash(const GaussianCloud& cloud) {
  std::uint64_t hash = kFnv1aStart;
  const auto add = [&hash](float value) {
    hash = fnv1a(hash, static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value)));
  };
  const auto add_all = [&add](const auto& vector) {
    for (int i = 0; i < vector.length(); ++i) add(vector[i]);
  };
  for (const Gaussian& one : cloud.gaussians) {
    add_all(one.position);
    add_all(one.scale);
    add_all(one.rotation);
    add(one.opacity);
  }
  for (const glm::vec3& harmonic : cloud.harmonics) add_all(harmonic);
  if (cloud.antialiased) hash = fnv1a(hash, "antialiased");
  if (cloud.linear) hash = fnv1a(hash, "linear");
  return hash;
}

}  // namespace fastsplat::scene
