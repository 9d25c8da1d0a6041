// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

volume::Volume box() {
  volume::Volume volume;
  volume.dims = {41, 61, 21};
  volume.spacing = {1.0, 0.5, 2.0};
  return volume;
}

constexpr double kKernelRadius = 4.0;  // mm

Camera make(CameraParams params, int width = 320, int height = 200) {
  return Camera(params, box(), kKernelRadius, width, height);
}

// N-8-10, N-8-13: exact vectors.
TEST(Camera, SeesAHeadFromTheFrontUpright) {
  const Camera front = make({.azimuth = 0.0, .elevation = 0.0});
  EXPECT_EQ(front.direction(), glm::dvec3(0, -1, 0));  // from anterior to posterior
  EXPECT_EQ(front.down(), glm::dvec3(0, 0, -1));       // superior is up
  EXPECT_EQ(front.right(), glm::dvec3(-1, 0, 0));      // the head's right is on the image's left
  const Camera side = make({.azimuth = 90.0, .elevation = 0.0});
  EXPECT_EQ(side.direction(), glm::dvec3(-1, 0, 0));
  const Camera above = make({.azimuth = 0.0, .elevation = 90.0});
  EXPECT_EQ(above.direction(), glm::dvec3(0, 0, -1));
  EXPECT_EQ(make({.azimuth = 0.0, .elevation = 0.0, .roll = 90.0}).right(), glm::dvec3(0, 0, -1));
}

// N-8-10.
TEST(Camera, AxesAreRightHandedUnitVectors) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-400.0, 400.0);
  for (int i = 0; i < 200; ++i) {
    const Camera camera = make({.azimuth = angle(random), .elevation = angle(random), .roll = angle(random)});
    EXPECT_NEAR(glm::length(camera.direction()), 1.0, 1e-14);
    EXPECT_NEAR(glm::length(camera.right()), 1.0, 1e-14);
    EXPECT_LT(glm::length(glm::cross(camera.right(), camera.down()) - camera.direction()), 1e-14);
  }
}

// N-8-15.
TEST(Camera, ProjectAndRayAgree) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  // About ten roundings of numbers up to the image's size and the eye's distance.
  const double limit = 100.0 * 1000.0 * 0x1p-53;
  double worst_pixel = 0.0;
  double worst_depth = 0.0;
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    for (int i = 0; i < 500; ++i) {
      const Camera camera = make({.projection = projection,
                                  .azimuth = 180 * unit(random),
                                  .elevation = 90 * unit(random),
                                  .roll = 180 * unit(random),
                                  .zoom = 1.5 + unit(random),
                                  .fov = 25 + 20 * unit(random)});
      const double x = 160 + 160 * unit(random);
      const double y = 100 + 100 * unit(random);
      const Ray ray = camera.ray(x, y);
      const double along = 20.0 * unit(random);
      const ScreenPoint hit = camera.project(ray.origin + along * ray.direction);
      worst_pixel = std::max({worst_pixel, std::abs(hit.x - x), std::abs(hit.y - y)});
      worst_depth = std::max(worst_depth, std::abs(hit.depth - along * ray.depth_per_mm));
      EXPECT_NEAR(glm::dot(ray.origin, camera.direction()), 0.0, limit);
      EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-14);
    }
  }
  std::printf("[figure] project(ray) - pixel = %.3g px (limit %.3g)\n", worst_pixel, limit);
  std::printf("[figure] project(ray) depth = %.3g mm (limit %.3g)\n", worst_depth, limit);
  EXPECT_LE(worst_pixel, limit);
  EXPECT_LE(worst_depth, limit);
}

// N-8-11.
TEST(Camera, ScaleIsPixelsPerMillimetreThere) {
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    const Camera camera = make({.projection = projection, .azimuth = 20.0, .elevation = 40.0});
    for (const double depth : {-15.0, 0.0, 15.0}) {
      const glm::dvec3 here = depth * camera.direction();
      const ScreenPoint p = camera.project(here);
      const ScreenPoint q = camera.project(here + camera.right());
      EXPECT_NEAR(q.x - p.x, p.scale, 1e-11);
      EXPECT_NEAR(p.depth, depth, 1e-12);
      EXPECT_DOUBLE_EQ(p.x, 159.5);
      EXPECT_DOUBLE_EQ(p.y, 99.5);
    }
  }
}

// N-8-12.
TEST(Camera, BoundingSphereAndKernelFitTheSmallerSide) {
  const double radius = box().bounding_radius() + kKernelRadius;
  const Camera flat = make({.projection = Projection::Orthographic});
  EXPECT_NEAR(flat.project(radius * flat.down()).y, 199.5, 1e-9);  // the edge of the last row
  EXPECT_TRUE(std::isinf(flat.eye_distance()));
  const Camera deep = make({.projection = Projection::Perspective, .fov = 40.0});
  // The tangent from the eye touches the sphere where sin = radius / distance.
  const double s = radius / deep.eye_distance();
  const glm::dvec3 touch = radius * (std::sqrt(1 - s * s) * deep.down() - s * deep.direction());
  EXPECT_NEAR(deep.project(touch).y, 199.5, 1e-9);
}

// N-8-12.
TEST(Camera, ZoomBringsTheEyeNearerAndKeepsTheFieldOfView) {
  const Camera one = make({.projection = Projection::Perspective, .zoom = 1.0});
  const Camera two = make({.projection = Projection::Perspective, .zoom = 2.0});
  EXPECT_NEAR(one.eye_distance(), 2.0 * two.eye_distance(), 1e-9);
  const auto corner = [](const Camera& camera) { return glm::dot(camera.ray(0, 0).direction, camera.direction()); };
  EXPECT_NEAR(corner(one), corner(two), 1e-14);
}

// The formulas that docs/guide/vtk.md gives, and N-8-10, N-8-12.
TEST(Camera, MatchesTheGuidesVtkCamera) {
  const double a = 37.0 * M_PI / 180.0, e = -21.0 * M_PI / 180.0, zoom = 1.7;
  const Camera camera = make({.azimuth = 37.0, .elevation = -21.0, .zoom = zoom});
  const glm::dvec3 d = -glm::dvec3(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e));
  const glm::dvec3 up(-std::sin(a) * std::sin(e), -std::cos(a) * std::sin(e), std::cos(e));
  const double off = glm::distance(camera.direction(), d) + glm::distance(-camera.down(), up);
  const double s = zoom * 100.0 / (box().bounding_radius() + kKernelRadius);
  std::printf("[figure] vtk_camera: axes off by %.2g, scale off by %.2g (limit 1e-12)\n", off,
              std::abs(camera.scale_at(0.0) - s));
  EXPECT_LT(off, 1e-12);
  EXPECT_NEAR(camera.scale_at(0.0), s, 1e-12);
}

TEST(Camera, RefusesViewsWithoutAPicture) {
  const auto message = [](CameraParams params, int width = 10, int height = 10) {
    return refusal([&] { make(params, width, height); }, ExitCode::Usage);
  };
  EXPECT_THAT(message({.zoom = 0.0}), HasSubstr("zoom"));
  EXPECT_THAT(message({.zoom = -1.0}), HasSubstr("zoom"));
  EXPECT_THAT(message({.zoom = NAN}), HasSubstr("zoom"));
  EXPECT_THAT(message({.azimuth = INFINITY}), HasSubstr("azimuth"));
  EXPECT_THAT(message({.projection = Projection::Perspective, .fov = 1.0}), HasSubstr("field of view"));
  EXPECT_THAT(message({.projection = Projection::Perspective, .fov = 150.0}), HasSubstr("field of view"));
  EXPECT_THAT(message({.projection = Projection::Perspective, .zoom = 4.0, .fov = 30.0}), HasSubstr("inside"));
  EXPECT_THAT(message({}, 0, 10), HasSubstr("no pixels"));
  EXPECT_NO_THROW(make({.projection = Projection::Perspective, .zoom = 3.8, .fov = 30.0}));
}

}  // namespace
}  // namespace fastsplat::scene
