// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

struct Turn {
  double sin, cos;
};

/// Exact at multiples of 90 degrees, so that axis views have exactly axis-parallel vectors.
Turn turn(double degrees) {
  const double quarters = std::nearbyint(degrees / 90.0);
  const double rest = (degrees - 90.0 * quarters) * std::numbers::pi / 180.0;
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch (static_cast<int>(std::fmod(std::fmod(quarters, 4.0) + 4.0, 4.0))) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

[[noreturn]] void bad(const std::string& what, const std::string& expected, double got, const std::string& fix,
                      const char* where = "camera") {
  throw_usage({.where = where, .what = what, .expected = expected, .got = fmt::format("{}", got), .fix = fix});
}

void check_angle(const char* name, double degrees) {
  if (!(std::abs(degrees) <= 3600.0))
    bad(fmt::format("{} is out of range", name), "-3600..3600 degrees", degrees, "angles repeat every 360 degrees");
}

}  // namespace

Camera::Camera(const CameraParams& params, const volume::Volume& volume, double kernel_radius_mm, int width, int height)
    : Camera(params, volume.bounding_radius() + kernel_radius_mm, width, height) {}

Camera::Camera(const CameraParams& params, double radius, int width, int height)
    : projection_(params.projection), width_(width), height_(height), centre_(0.5 * (width - 1), 0.5 * (height - 1)) {
  check_angle("azimuth", params.azimuth);
  check_angle("elevation", params.elevation);
  check_angle("roll", params.roll);
  if (!(params.zoom > 0.0 && params.zoom <= 1e6))
    bad("zoom is out of range", "0 < zoom <= 1e6", params.zoom, "1 fits the volume to the image");
  if (width < 1 || height < 1) {
    bad("the image has no pixels", "width and height of at least 1", std::min(width, height),
        "give a size such as 512");
  }

  const Turn azimuth = turn(params.azimuth);
  const Turn elevation = turn(params.elevation);
  const Turn roll = turn(params.roll);
  forward_ = -glm::dvec3(azimuth.sin * elevation.cos, azimuth.cos * elevation.cos, elevation.sin);
  const glm::dvec3 level(-azimuth.cos, azimuth.sin, 0.0);
  const glm::dvec3 upright = glm::cross(forward_, level);
  right_ = roll.cos * level + roll.sin * upright;
  down_ = roll.cos * upright - roll.sin * level;

  const double zoom = params.fit == Fit::Content ? 1.0 : params.zoom;
  const double half_side = 0.5 * std::min(width, height);
  if (projection_ == Projection::Orthographic) {
    scale_ = zoom * half_side / radius;
    eye_distance_ = std::numeric_limits<double>::infinity();
    return;
  }
  if (!(params.fov > 1.0 && params.fov < 150.0))
    bad("field of view is out of range", "1..150 degrees, exclusive", params.fov, "30 is the default");
  const double half_fov = params.fov * std::numbers::pi / 360.0;
  eye_distance_ = radius / (std::sin(half_fov) * zoom);
  if (eye_distance_ <= radius) {
    bad("the eye is inside the volume's bounding sphere",
        fmt::format("zoom < {:.3g} at this field of view", 1.0 / std::sin(half_fov)), params.zoom,
        "lower the zoom, or the field of view together with it", "camera.zoom");
  }
  eye_ = -eye_distance_ * forward_;
  scale_ = half_side / std::tan(half_fov) / eye_distance_;
}

Camera::Camera(const Pinhole& pinhole)
    : projection_(Projection::Perspective),
      forward_(pinhole.forward),
      right_(pinhole.right),
      down_(pinhole.down),
      scale_(pinhole.focal.x),
      eye_distance_(1.0),
      width_(pinhole.width),
      height_(pinhole.height),
      centre_(pinhole.centre),
      eye_(pinhole.eye),
      at_(glm::dot(pinhole.eye, right_), glm::dot(pinhole.eye, down_), glm::dot(pinhole.eye, forward_) + 1.0),
      stretch_(pinhole.focal.y / pinhole.focal.x) {}

Camera Camera::enlarged(double factor, const glm::dvec2& middle) const {
  Camera camera = *this;
  camera.scale_ *= factor;
  camera.centre_ = 0.5 * glm::dvec2(width_ - 1, height_ - 1) + factor * (centre_ - middle);
  return camera;
}

double Camera::scale_at(double depth) const {
  return projection_ == Projection::Orthographic ? scale_ : scale_ * (eye_distance_ / (eye_distance_ + depth));
}

ScreenPoint Camera::project(const glm::dvec3& world) const {
  const double depth = glm::dot(world, forward_) - at_.z;
  const double scale = scale_at(depth);
  return {.x = centre_.x + scale * (glm::dot(world, right_) - at_.x),
          .y = centre_.y + stretch_ * scale * (glm::dot(world, down_) - at_.y),
          .depth = depth,
          .scale = scale};
}

Ray Camera::ray(double x, double y) const {
  const double across = (x - centre_.x) / scale_;
  const double along = (y - centre_.y) / (stretch_ * scale_);
  const glm::dvec3 from_axis = across * right_ + along * down_;
  const glm::dvec3 origin = from_axis + at_.x * right_ + at_.y * down_ + at_.z * forward_;
  if (projection_ == Projection::Orthographic) return {origin, forward_, 1.0};
  const glm::dvec3 direction = glm::normalize(from_axis + eye_distance_ * forward_);
  return {origin, direction, glm::dot(direction, forward_)};
}

}  // namespace fastsplat::scene
