// SPDX-License-Identifier: Apache-2.0
#include "scene/techniques.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

[[noreturn]] void refuse(const char* where, std::string what, std::string expected, double got, std::string fix) {
  throw_usage({.where = where,
               .what = std::move(what),
               .expected = std::move(expected),
               .got = fmt::format("{}", got),
               .fix = std::move(fix)});
}

void check_motion(const Motion& motion, const Camera& camera, double radius) {
  const double way = 0.5 * glm::length(motion.translate);
  if (way + radius < camera.eye_distance()) return;
  refuse("motion", "translate moves the volume past the eye",
         fmt::format("a path under {:.4g} mm", 2.0 * (camera.eye_distance() - radius)), 2.0 * way,
         "shorten it, or lower the zoom");
}

void check_lens(const Lens& lens, const Camera& camera) {
  if (lens.depth_of_field == DepthOfField::Off) return;
  if (!(lens.aperture >= 0.0)) refuse("lens", "aperture is negative", "0 mm or more", lens.aperture, "0 is a pinhole");
  if (!(lens.focus > -camera.eye_distance())) {
    refuse("lens", "focus is behind the eye", fmt::format("more than {:.4g} mm", -camera.eye_distance()), lens.focus,
           "focus counts from the volume's centre, positive is farther");
  }
}

}  // namespace

double circle_of_confusion(const Camera& camera, const Lens& lens, double depth) {
  return lens.aperture * std::abs(camera.scale_at(depth) - camera.scale_at(lens.focus));
}

void check_techniques(const Motion& motion, const Lens& lens, const Camera& camera, double radius) {
  check_motion(motion, camera, radius);
  check_lens(lens, camera);
}

const std::vector<std::string>& footprint_shape_names() {
  static const std::vector<std::string> names = {"circle", "ellipse"};
  return names;
}

const std::vector<std::string>& depth_of_field_names() {
  static const std::vector<std::string> names = {"off", "splats", "sheets"};
  return names;
}

}  // namespace fastsplat::scene
