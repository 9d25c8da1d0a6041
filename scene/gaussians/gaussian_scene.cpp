// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gaussian_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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

/// The camera of a world whose origin is `middle`.
Camera placed(const GaussianDescription& description, const glm::dmat3& turn, const glm::dvec3& middle) {
  const PlacedCamera& from = *description.placed;
  Pinhole to{.eye = turn * (from.eye - middle), .width = description.width, .height = description.height};
  if (from.axes) {
    const glm::dmat3 axes = turn * *from.axes;
    to.right = axes[0], to.down = axes[1], to.forward = axes[2];
  } else {
    const glm::dvec3 way = turn * (from.look_at.value_or(middle) - middle) - to.eye;
    if (!(glm::length(way) > 0.0)) {
      throw_usage({.where = "--eye",
                   .what = "the eye looks at itself",
                   .expected = "two different points",
                   .got = fmt::format("{:g},{:g},{:g} twice", from.eye.x, from.eye.y, from.eye.z),
                   .fix = "move --eye or --look-at"});
    }
    to.forward = glm::normalize(way);
    const glm::dvec3 level = glm::cross(to.forward, glm::dvec3(0.0, 0.0, 1.0));
    const glm::dvec3 right = glm::length(level) > 1e-9 ? glm::normalize(level) : glm::dvec3(-1.0, 0.0, 0.0);
    const double roll = glm::radians(description.camera.roll);
    const glm::dvec3 upright = glm::cross(to.forward, right);
    to.right = std::cos(roll) * right + std::sin(roll) * upright;
    to.down = std::cos(roll) * upright - std::sin(roll) * right;
  }
  const int side = std::min(to.width, to.height);
  const Intrinsics intrinsics =
      from.intrinsics
          ? resized(*from.intrinsics, to.width, to.height)
          : Intrinsics{.focal = glm::dvec2(0.5 * side / std::tan(0.5 * glm::radians(description.camera.fov))),
                       .centre = 0.5 * glm::dvec2(to.width - 1, to.height - 1)};
  to.focal = intrinsics.focal, to.centre = intrinsics.centre;
  return Camera(to);
}

void check_limit(const char* flag, double value, const Limits& limits, double usual) {
  if (value >= limits.low && value <= limits.high) return;
  throw_usage({.where = flag,
               .what = "out of range",
               .expected = fmt::format("{:g}..{:g}", limits.low, limits.high),
               .got = fmt::format("{:g}", value),
               .fix = fmt::format("{:g} is the default", usual)});
}

GaussianScene view_of(const GaussianDescription& description, std::shared_ptr<const GaussianCloud> cloud,
                      const glm::dvec3& middle, double radius) {
  const glm::dmat3 turn = turn_of(description.up);
  // Also where the camera is placed: it checks angles, field of view and size.
  Camera camera(description.camera, radius, description.width, description.height);
  if (description.placed) camera = placed(description, turn, middle);
  const double near = description.placed ? kNearPlaced : kNearShare * camera.eye_distance();
  if (description.near) check_limit("--near", *description.near, kNearLimits, near);
  const auto order = description.order.value_or(cloud->by_distance ? GaussianSort::Distance : GaussianSort::Depth);
  return {.description = description,
          .cloud = std::move(cloud),
          .turn = turn,
          .middle = middle,
          .radius = radius,
          .camera = camera,
          .near = description.near.value_or(near),
          .order = order};
}

}  // namespace

const std::vector<std::string>& up_axis_names() {
  static const std::vector<std::string> names = {"x", "y", "z", "-x", "-y", "-z"};
  return names;
}

UpAxis usual_up(const std::string& name_or_path) {
  return files_of_gaussians(name_or_path).empty() ? UpAxis::Z : UpAxis::MinusY;
}

void crop(GaussianCloud& cloud, const RealBox& box) {
  const auto count = static_cast<std::size_t>(harmonic_count(cloud.degree));
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  std::size_t kept = 0;
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const glm::vec3 at = cloud.gaussians[i].position;
    low = glm::min(low, glm::dvec3(at)), high = glm::max(high, glm::dvec3(at));
    // As floats: the ends are included, and 0.6 is not the float nearest to it.
    if (glm::any(glm::lessThan(at, glm::vec3(box.low))) || glm::any(glm::greaterThan(at, glm::vec3(box.high))))
      continue;
    cloud.gaussians[kept] = cloud.gaussians[i];
    numbers.push_back(cloud.number_of(i));
    const auto from = cloud.harmonics.begin() + static_cast<std::ptrdiff_t>(i * count);
    std::copy_n(from, count, cloud.harmonics.begin() + static_cast<std::ptrdiff_t>(kept * count));
    ++kept;
  }
  if (kept == 0) {
    const auto text = [](const glm::dvec3& a, const glm::dvec3& b) {
      return fmt::format("{:g}..{:g},{:g}..{:g},{:g}..{:g}", a.x, b.x, a.y, b.y, a.z, b.z);
    };
    throw_usage({.where = "--crop",
                 .what = "no Gaussian has its centre in the box",
                 .expected = "a part of " + text(low, high),
                 .got = text(box.low, box.high),
                 .fix = "`fastsplat gaussians info` prints where they are"});
  }
  cloud.gaussians.resize(kept);
  cloud.harmonics.resize(kept * count);
  cloud.cropped = true;
  cloud.numbers = std::move(numbers);
}

GaussianScene build_gaussian_scene(const GaussianDescription& description, std::shared_ptr<const GaussianCloud> cloud) {
  assert(!cloud->gaussians.empty());
  check_limit("--low-pass", description.low_pass, kLowPassLimits, GaussianDescription{}.low_pass);
  check_limit("--cutoff", description.cutoff, kCutoffLimits, GaussianDescription{}.cutoff);
  const glm::dvec3 middle = middle_of(*cloud);
  const double radius = radius_of(*cloud, middle, description.cutoff);
  return view_of(description, std::move(cloud), middle, radius);
}

GaussianScene seen_by(const GaussianDescription& description, const GaussianScene& scene) {
  return view_of(description, scene.cloud, scene.middle, scene.radius);
}

}  // namespace fastsplat::scene
