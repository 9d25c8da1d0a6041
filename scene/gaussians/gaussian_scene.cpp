// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gaussian_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

/// A rotation, without mirroring, after which `up` is z.
glm::dmat3 turn_of(UpAxis up) {
  const auto rows = [](const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
    return glm::transpose(glm::dmat3(x, y, z));
  };
  switch (up) {
    case UpAxis::X:
      return rows({0, 0, -1}, {0, 1, 0}, {1, 0, 0});
    case UpAxis::Y:
      return rows({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    case UpAxis::Z:
      break;
    case UpAxis::MinusX:
      return rows({0, 0, 1}, {0, 1, 0}, {-1, 0, 0});
    case UpAxis::MinusY:
      return rows({1, 0, 0}, {0, 0, 1}, {0, -1, 0});
    case UpAxis::MinusZ:
      return rows({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
  }
  return glm::dmat3(1.0);
}

/// The value that `share` of the values do not exceed.
double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

glm::dvec3 middle_of(const GaussianCloud& cloud) {
  glm::dvec3 middle;
  std::vector<double> along(cloud.gaussians.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(cloud.gaussians, along.begin(),
                           [axis](const Gaussian& one) { return static_cast<double>(one.position[axis]); });
    middle[axis] = quantile(along, 0.5);
  }
  return middle;
}

double radius_of(const GaussianCloud& cloud, const glm::dvec3& middle, double cutoff) {
  std::vector<double> reach(cloud.gaussians.size());
  std::ranges::transform(cloud.gaussians, reach.begin(), [&](const Gaussian& one) {
    const auto largest = static_cast<double>(std::max({one.scale.x, one.scale.y, one.scale.z}));
    return glm::distance(glm::dvec3(one.position), middle) + cutoff * largest;
  });
  const double radius = quantile(reach, 0.95);
  return radius > 0.0 ? radius : 1.0;
}

void check_limit(const char* flag, double value, const Limits& limits, double usual) {
  if (value >= limits.low && value <= limits.high) return;
  throw_usage({.where = flag,
               .what = "out of range",
               .expected = fmt::format("{:g}..{:g}", limits.low, limits.high),
               .got = fmt::format("{:g}", value),
               .fix = fmt::format("{:g} is the default", usual)});
}

}  // namespace

const std::vector<std::string>& up_axis_names() {
  static const std::vector<std::string> names = {"x", "y", "z", "-x", "-y", "-z"};
  return names;
}

UpAxis usual_up(const std::string& name_or_path) {
  return files_of_gaussians(name_or_path).empty() ? UpAxis::Z : UpAxis::MinusY;
}

GaussianScene build_gaussian_scene(const GaussianDescription& description, std::shared_ptr<const GaussianCloud> cloud) {
  assert(!cloud->gaussians.empty());
  check_limit("--low-pass", description.low_pass, kLowPassLimits, GaussianDescription{}.low_pass);
  check_limit("--cutoff", description.cutoff, kCutoffLimits, GaussianDescription{}.cutoff);
  const glm::dvec3 middle = middle_of(*cloud);
  const double radius = radius_of(*cloud, middle, description.cutoff);
  return {.description = description,
          .cloud = std::move(cloud),
          .turn = turn_of(description.up),
          .middle = middle,
          .radius = radius,
          .camera = Camera(description.camera, radius, description.width, description.height)};
}

}  // namespace fastsplat::scene
