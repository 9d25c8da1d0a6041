// SPDX-License-Identifier: Apache-2.0
// Projected Gaussians against numbers: the covariance of points of the Gaussian, projected one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel/parallel.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/projected_gaussian.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

GaussianScene scene_of(GaussianCloud cloud, GaussianDescription description) {
  return build_gaussian_scene(description, std::make_shared<GaussianCloud>(std::move(cloud)));
}

GaussianDescription view(Projection projection, double azimuth = 37.0, double elevation = 21.0) {
  GaussianDescription description;
  description.camera.projection = projection;
  description.camera.azimuth = azimuth;
  description.camera.elevation = elevation;
  description.camera.roll = 13.0;
  description.up = UpAxis::MinusY;
  return description;
}

/// Mean and covariance on the screen of a Gaussian's points, by Gauss and Hermite's rule of five points an axis: exact
/// for polynomials up to the ninth degree.
ScreenShape numeric_covariance(const GaussianScene& scene, const Gaussian& gaussian) {
  constexpr std::array<double, 5> kAt{-2.856970013872806, -1.355626179974266, 0.0, 1.355626179974266,
                                      2.856970013872806};
  constexpr std::array<double, 5> kShare{0.01125741132772068, 0.2220759220056126, 0.5333333333333333,
                                         0.2220759220056126, 0.01125741132772068};
  const glm::dmat3 axes = axes_of(gaussian);
  const ScreenPoint centre = scene.camera.project(scene.turn * (glm::dvec3(gaussian.position) - scene.middle));
  double x = 0.0, y = 0.0;
  ScreenShape moments;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      for (std::size_t k = 0; k < 5; ++k) {
        const glm::dvec3 own = glm::dvec3(gaussian.scale) * glm::dvec3(kAt[i], kAt[j], kAt[k]);
        const glm::dvec3 file = glm::dvec3(gaussian.position) + axes * own;
        ScreenPoint at = scene.camera.project(scene.turn * (file - scene.middle));
        at.x -= centre.x, at.y -= centre.y;  // of small numbers squares lose nothing
        const double share = kShare[i] * kShare[j] * kShare[k];
        x += share * at.x, y += share * at.y;
        moments.xx += share * at.x * at.x, moments.xy += share * at.x * at.y, moments.yy += share * at.y * at.y;
      }
  return {moments.xx - x * x, moments.xy - x * y, moments.yy - y * y};
}

TEST(GaussianProjection, IsTheCovarianceOfProjectedPoints) {
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    GaussianCloud cloud = make_synthetic_gaussians("cloud:200");
    for (Gaussian& one : cloud.gaussians) one.scale *= 0.05F;  // where a plane touches the perspective well enough
    const GaussianScene scene = scene_of(cloud, view(projection));
    double worst = 0.0;
    for (std::uint32_t i = 0; i < cloud.gaussians.size(); ++i) {
      ProjectedGaussian splat;
      ASSERT_TRUE(project(scene, i, splat));
      const ScreenShape numeric = numeric_covariance(scene, cloud.gaussians[i]);
      const double size = numeric.xx + numeric.yy, low_pass = scene.description.low_pass;
      for (const double apart : {splat.shape.xx - low_pass - numeric.xx, splat.shape.xy - numeric.xy,
                                 splat.shape.yy - low_pass - numeric.yy})
        worst = std::max(worst, std::abs(apart) / size);
    }
    const bool flat = projection == Projection::Orthographic;
    figure(flat ? "orthographic: worst relative difference" : "perspective: worst relative difference", worst);
    // Perspective: what EWA leaves out goes with (deviation / distance)^2, here 0.014^2.
    EXPECT_LT(worst, flat ? 1e-9 : 2e-3);
  }
}

TEST(GaussianProjection, LowPassIsAddedAndOpacityCapped) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:3");
  cloud.gaussians[1].opacity = 1.0F;
  GaussianDescription description = view(Projection::Perspective);
  const GaussianScene usual = scene_of(cloud, description);
  description.low_pass = 2.3;
  const GaussianScene wide = scene_of(cloud, description);
  ProjectedGaussian a, b;
  ASSERT_TRUE(project(usual, 1, a));
  ASSERT_TRUE(project(wide, 1, b));
  EXPECT_NEAR(b.shape.xx - a.shape.xx, 2.0, 1e-12);
  EXPECT_NEAR(b.shape.yy - a.shape.yy, 2.0, 1e-12);
  EXPECT_EQ(a.shape.xy, b.shape.xy);
  EXPECT_EQ(a.opacity, kMostAlpha);
  EXPECT_NEAR(a.q(std::sqrt(a.shape.xx), 0.0), a.shape.xx * a.shape.yy / a.shape.determinant(), 1e-12);
}

// The axis that the file declares as up is up in the picture, and no turn is a mirror.
TEST(GaussianProjection, UpIsUp) {
  for (const UpAxis up : {UpAxis::X, UpAxis::Y, UpAxis::Z, UpAxis::MinusX, UpAxis::MinusY, UpAxis::MinusZ}) {
    GaussianCloud cloud = make_synthetic_gaussians("cloud:3");
    const int axis = static_cast<int>(up) % 3;
    const float sign = static_cast<int>(up) < 3 ? 1.0F : -1.0F;
    for (Gaussian& one : cloud.gaussians) one.position = glm::vec3(0.0F), one.scale = glm::vec3(0.1F);
    cloud.gaussians[2].position[axis] = sign;
    GaussianDescription description = view(Projection::Perspective, 30.0, 10.0);
    description.camera.roll = 0.0;
    description.up = up;
    const GaussianScene scene = scene_of(cloud, description);
    ProjectedGaussian middle, higher;
    ASSERT_TRUE(project(scene, 0, middle));
    ASSERT_TRUE(project(scene, 2, higher));
    EXPECT_LT(higher.y, middle.y - 10.0) << static_cast<int>(up);
    EXPECT_NEAR(higher.x, middle.x, 1e-9) << static_cast<int>(up);
    EXPECT_NEAR(glm::determinant(scene.turn), 1.0, 1e-12);
  }
}

TEST(GaussianProjection, ColoursAreSeenFromTheEyeInTheFilesAxes) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:3");
  for (Gaussian& one : cloud.gaussians) one.position = glm::vec3(0.0F);
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    const GaussianScene scene = scene_of(cloud, view(projection));
    ProjectedGaussian splat;
    ASSERT_TRUE(project(scene, 0, splat));
    const glm::dvec3 away = glm::transpose(scene.turn) * scene.camera.direction();  // through the middle
    const glm::dvec3 expected = colour_at(cloud.harmonics_of(0), away);
    EXPECT_NEAR(glm::distance(splat.colour, expected), 0.0, 1e-12);
  }
}

// N-8-82: nearest first.
TEST(GaussianProjection, SplatsBehindOrOutsideAreCulledAndTheRestSorted) {
  GaussianCloud cloud = make_synthetic_gaussians("shells:400");
  const std::size_t usual = cloud.gaussians.size();
  GaussianDescription description = view(Projection::Perspective);
  description.up = UpAxis::Z;
  const GaussianScene plain = scene_of(cloud, description);
  const glm::dvec3 back = -plain.camera.direction();
  const double eye = plain.camera.eye_distance();
  // Twice as far as the eye, a little behind the near plane, a little before it, and off to the side.
  for (const double way : {2.0, 0.9901, 0.9899})
    cloud.gaussians.push_back({.position = plain.middle + way * eye * back, .scale = glm::vec3(1e-4F)});
  cloud.gaussians.push_back(
      {.position = plain.middle + 3.0 * plain.radius * plain.camera.right(), .scale = glm::vec3(0.01F)});
  cloud.harmonics.resize(cloud.gaussians.size() * 16);
  for (std::size_t i = usual; i < cloud.gaussians.size(); ++i) cloud.gaussians[i].opacity = 0.5F;
  auto scene = scene_of(cloud, description);
  scene.middle = plain.middle, scene.radius = plain.radius, scene.camera = plain.camera;
  scene.near = plain.near;
  ProjectionReport report;
  const auto all = project_all(scene, &report);
  EXPECT_EQ(report.gaussians, usual + 4);
  EXPECT_EQ(report.near, 2U);
  EXPECT_EQ(report.outside, 1U);
  ASSERT_EQ(all.size(), usual + 1);
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, &ProjectedGaussian::depth));
  EXPECT_EQ(all.front().number, usual + 2) << "nearest first";
  figure("drawn", static_cast<double>(all.size()));
}

// Several parts of Gaussians, and many at equal depths: the order is that of the file.
TEST(GaussianProjection, ThreadsNeverChangeTheOrder) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:20000");
  for (std::size_t i = 0; i + 5 < cloud.gaussians.size(); i += 3)
    cloud.gaussians[i + 5].position = cloud.gaussians[i].position;
  const GaussianScene scene = scene_of(cloud, view(Projection::Perspective));
  ProjectionReport counts;
  const auto all = project_all(scene, &counts, 1);
  std::size_t equal_depths = 0, checked = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ProjectedGaussian alone;
    ASSERT_TRUE(project(scene, all[i].number, alone));
    EXPECT_EQ(alone.x, all[i].x);
    EXPECT_EQ(alone.depth, all[i].depth);
    ++checked;
    if (i == 0) continue;
    ASSERT_LE(all[i - 1].depth, all[i].depth);
    if (all[i - 1].depth != all[i].depth) continue;
    ++equal_depths;
    ASSERT_LT(all[i - 1].number, all[i].number);
  }
  for (const int threads : {2, 3, 8}) {
    ProjectionReport report;
    const auto same = project_all(scene, &report, threads);
    EXPECT_TRUE(std::ranges::equal(same, all, {}, &ProjectedGaussian::number, &ProjectedGaussian::number)) << threads;
    EXPECT_EQ(report.near, counts.near);
    EXPECT_EQ(report.outside, counts.outside);
  }
  figure("Gaussians in several parts", static_cast<double>(checked));
  figure("pairs at equal depths", static_cast<double>(equal_depths));
  EXPECT_GT(checked, 3 * kPart);
  EXPECT_GT(equal_depths, 1000U);
}

// The depth of the maximum along a ray, against a search along it.
TEST(GaussianProjection, DepthOfMaximum) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  double worst = 0.0;
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    const GaussianScene scene = scene_of(cloud, view(projection));
    for (std::uint32_t i = 0; i < cloud.gaussians.size(); ++i) {
      ProjectedGaussian splat;
      ASSERT_TRUE(project(scene, i, splat));
      const double x = splat.x + 2.0, y = splat.y - 1.0;
      const Ray ray = scene.camera.ray(x, y);
      const glm::dmat3 inverse = glm::inverse(covariance(cloud.gaussians[i]));
      const auto q = [&](double depth) {
        const glm::dvec3 world = ray.origin + depth / ray.depth_per_mm * ray.direction;
        const glm::dvec3 off =
            glm::transpose(scene.turn) * world + scene.middle - glm::dvec3(cloud.gaussians[i].position);
        return glm::dot(off, inverse * off);
      };
      double low = -10.0, high = 10.0;  // q is convex
      for (int step = 0; step < 200; ++step) {
        const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
        (q(a) < q(b) ? high : low) = q(a) < q(b) ? b : a;
      }
      worst = std::max(worst, std::abs(depth_of_maximum(scene, splat, x, y) - 0.5 * (low + high)));
    }
  }
  figure("worst difference of depth", worst);
  EXPECT_LT(worst, 1e-5);
}

TEST(GaussianScene, LimitsAreReportedAndTheMiddleIsRobust) {
  GaussianCloud cloud = make_synthetic_gaussians("shells:400");
  const auto usual = scene_of(cloud, {});
  cloud.gaussians[7].position = glm::vec3(1e6F, -1e6F, 1e6F);  // one that went astray
  const auto astray = scene_of(cloud, {});
  EXPECT_NEAR(astray.radius, usual.radius, 0.1 * usual.radius);
  EXPECT_LT(glm::distance(astray.middle, usual.middle), 0.1);
  for (const auto& [low_pass, cutoff, flag] :
       {std::tuple{0.0, 3.0, "--low-pass"}, std::tuple{0.3, 0.5, "--cutoff"}, std::tuple{0.3, 4.5, "--cutoff"}}) {
    GaussianDescription description;
    description.low_pass = low_pass, description.cutoff = cutoff;
    try {
      scene_of(cloud, description);
      ADD_FAILURE() << flag << " was taken";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      EXPECT_EQ(error.parts().where, flag);
    }
  }
}

}  // namespace
}  // namespace fastsplat::scene
