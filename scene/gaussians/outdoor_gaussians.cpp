// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/outdoor_gaussians.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/gaussians/synthetic_parts.hpp"

namespace fastsplat::scene {
namespace {

constexpr double kGroundShare = 0.30, kObjectShare = 0.55, kSkyShare = 0.15;
constexpr double kGroundRadius = 20.0, kSkyRadius = 60.0;
constexpr int kObjects = 40;
/// The sky reaches a little below the horizon.
constexpr double kSkyLow = -0.1;
/// Median of the longest deviation, in distances between neighbours.
constexpr double kLength = 1.6;
/// Its limits on the ground and objects, and in the sky. Trainers prune Gaussians that are large in a picture.
constexpr double kLongest = 0.2, kLongestSky = 0.1 * kSkyRadius;

/// A place on a surface.
struct Spot {
  glm::dvec3 at, normal, colour;
  double apart;  ///< mean distance of neighbours there
  double longest = kLongest;
};

/// Half an ellipsoid that stands on the ground.
struct Object {
  glm::dvec2 centre;
  glm::dvec3 axes, colour;
  /// Of the half ellipsoid, by the sphere of the same volume.
  double area() const { return 2.0 * std::numbers::pi * std::pow(axes.x * axes.y * axes.z, 2.0 / 3.0); }
};

/// `height`: the least cosine to the z axis.
glm::dvec3 direction(Random& random, double height) {
  const double z = random.between(height, 1.0), angle = random.between(0.0, 2.0 * std::numbers::pi);
  const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {ring * std::cos(angle), ring * std::sin(angle), z};
}

std::vector<Object> objects_of(Random& random) {
  std::vector<Object> objects(kObjects);
  for (int i = 0; i < kObjects; ++i) {
    Object& one = objects[static_cast<std::size_t>(i)];
    const bool far = i % 3 == 2;
    const double radius = far ? random.between(8.0, 18.0) : random.between(0.0, 3.5);
    const double angle = random.between(0.0, 2.0 * std::numbers::pi);
    one.centre = {radius * std::cos(angle), radius * std::sin(angle)};
    for (int axis = 0; axis < 3; ++axis) one.axes[axis] = random.between(0.2, 1.0) * (axis == 2 && far ? 4.0 : 1.0);
    for (int c = 0; c < 3; ++c) one.colour[c] = random.between(0.1, 0.8);
  }
  return objects;
}

Spot ground(Random& random, int count) {
  // Uniform in the radius: the nearer to the middle, the denser, as cameras see more of it.
  const double radius = random.between(0.0, kGroundRadius), angle = random.between(0.0, 2.0 * std::numbers::pi);
  const glm::dvec2 at(radius * std::cos(angle), radius * std::sin(angle));
  const double pattern = std::sin(1.7 * at.x) * std::sin(2.3 * at.y) + 0.5 * std::sin(0.6 * at.x + 0.9 * at.y);
  const double area = 2.0 * std::numbers::pi * std::max(radius, 0.5) * kGroundRadius;
  return {{at.x, at.y, 0.02 * random.normal()},
          {0.0, 0.0, 1.0},
          glm::dvec3(0.32, 0.36, 0.2) + 0.12 * pattern * glm::dvec3(1.0, 0.6, 0.4),
          std::sqrt(area / (kGroundShare * count))};
}

Spot on_object(Random& random, const Object& object, int count) {
  const glm::dvec3 out = direction(random, 0.0), normal = glm::normalize(out / object.axes);
  const glm::dvec3 at = out * object.axes;
  const double light = 0.6 + 0.4 * normal.z;
  return {{object.centre.x + at.x, object.centre.y + at.y, at.z},
          normal,
          light * object.colour,
          std::sqrt(object.area() * kObjects / (kObjectShare * count))};
}

Spot sky(Random& random, int count) {
  const glm::dvec3 out = direction(random, kSkyLow);
  const double radius = kSkyRadius * random.between(0.9, 1.1);
  const double cloud = 0.5 + 0.5 * std::sin(7.0 * out.x + 3.0 * std::sin(5.0 * out.z)) * std::sin(6.0 * out.y);
  const glm::dvec3 blue = glm::mix(glm::dvec3(0.75, 0.8, 0.85), glm::dvec3(0.35, 0.55, 0.85), out.z);
  const double area = 2.0 * std::numbers::pi * kSkyRadius * kSkyRadius * (1.0 - kSkyLow);
  return {radius * out, -out, glm::mix(blue, glm::dvec3(0.88), 0.6 * cloud), std::sqrt(area / (kSkyShare * count)),
          kLongestSky};
}

Spot spot(Random& random, const std::vector<Object>& objects, int count) {
  const double kind = random.unit();
  if (kind < kGroundShare) return ground(random, count);
  if (kind >= kGroundShare + kObjectShare) return sky(random, count);
  const auto number = static_cast<std::size_t>(random.unit() * kObjects);
  return on_object(random, objects[number], count);
}

float opacity_of(Random& random) {
  const double kind = random.unit();
  if (kind < 0.45) return static_cast<float>(random.between(0.005, 0.1));
  return static_cast<float>(kind < 0.80 ? random.between(0.1, 0.9) : random.between(0.9, 1.0));
}

Gaussian gaussian_at(const Spot& spot, Random& random) {
  Gaussian one;
  one.position = spot.at;
  const double length = std::min(kLength * spot.apart * std::exp(0.55 * random.normal()), spot.longest);
  const double width = length / std::exp(std::max(0.0, 1.57 + 0.73 * random.normal()));
  const double thickness = width / std::exp(std::max(0.0, 1.16 + 0.97 * random.normal()));
  one.scale = glm::dvec3(length, width, thickness);
  glm::dvec3 tilt;
  for (int axis = 0; axis < 3; ++axis) tilt[axis] = 0.3 * random.normal();
  const glm::dvec4 turn = turn_to(glm::normalize(spot.normal + tilt));
  // After a rotation about the normal.
  const double half = random.between(0.0, std::numbers::pi), c = std::cos(half), s = std::sin(half);
  one.rotation = glm::dvec4(turn[0] * c, turn[1] * c + turn[2] * s, turn[2] * c - turn[1] * s, turn[0] * s);
  one.opacity = opacity_of(random);
  return one;
}

void append_colour(const Spot& spot, Random& random, std::vector<glm::vec3>& to) {
  constexpr std::array<double, 3> kOfDegree{0.08, 0.05, 0.03};
  const double shade = 0.06 * random.normal();
  to.push_back(constant_of(glm::clamp(spot.colour + shade, 0.02, 0.92)));
  for (int degree = 1; degree <= 3; ++degree) {
    // Deviations of uniform numbers of -1..1 are 1/sqrt(3): three quarters of the variance are common to the channels.
    const double all = 1.5 * kOfDegree[static_cast<std::size_t>(degree - 1)], each = all / std::numbers::sqrt3;
    for (int k = 0; k < 2 * degree + 1; ++k) {
      const double common = random.between(-all, all);
      glm::dvec3 one;
      for (int c = 0; c < 3; ++c) one[c] = common + random.between(-each, each);
      to.emplace_back(one);
    }
  }
}

}  // namespace

void append_outdoor(int count, std::uint64_t seed, GaussianCloud& cloud) {
  Random random(seed);
  const std::vector<Object> objects = objects_of(random);
  cloud.degree = 3;
  cloud.gaussians.reserve(static_cast<std::size_t>(count));
  cloud.harmonics.reserve(static_cast<std::size_t>(count) * static_cast<std::size_t>(harmonic_count(cloud.degree)));
  for (int i = 0; i < count; ++i) {
    const Spot place = spot(random, objects, count);
    cloud.gaussians.push_back(gaussian_at(place, random));
    append_colour(place, random, cloud.harmonics);
  }
}

}  // namespace fastsplat::scene
