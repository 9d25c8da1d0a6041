// SPDX-License-Identifier: Apache-2.0
// The floating-point renderer of 3-D Gaussians against closed formulas, and the cost of its order.
#include "golden/gaussians.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"

namespace fastsplat::golden {
namespace {

using scene::Gaussian;
using scene::GaussianCloud;

void figure(const std::string& name, double value, const char* unit = "") {
  std::printf("[figure] %s = %.4g %s\n", name.c_str(), value, unit);
}

scene::GaussianScene scene_of(GaussianCloud cloud, const scene::GaussianDescription& description) {
  return scene::build_gaussian_scene(description, std::make_shared<GaussianCloud>(std::move(cloud)));
}

scene::GaussianDescription view(int size, scene::Projection projection = scene::Projection::Orthographic) {
  scene::GaussianDescription description;
  description.camera.projection = projection;
  description.camera.azimuth = description.camera.elevation = 0.0;  // along -y
  description.width = description.height = size;
  description.up = scene::UpAxis::Z;
  return description;
}

void add(GaussianCloud& cloud, const Gaussian& gaussian, const glm::dvec3& colour) {
  cloud.gaussians.push_back(gaussian);
  cloud.harmonics.emplace_back((colour - glm::dvec3(0.5)) / scene::kConstantHarmonic);
}

double psnr(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.data.size(); ++i) sum += std::pow(double(a.data[i]) - double(b.data[i]), 2);
  return -10.0 * std::log10(sum / static_cast<double>(a.data.size()));
}

// One Gaussian, seen along an axis: its picture has a closed form.
TEST(GoldenGaussians, OneIsItsFormula) {
  GaussianCloud cloud;
  add(cloud, {.position = glm::vec3(0.0F), .scale = glm::vec3(0.3F, 0.05F, 0.1F), .opacity = 0.8F}, {0.25, 0.5, 1.5});
  const auto scene = scene_of(cloud, view(97));
  const double scale = scene.camera.scale_at(0.0), low_pass = scene.description.low_pass;
  const Image image = render_gaussians(scene, scene::project_all(scene));
  double worst = 0.0;
  int inside = 0;
  for (int y = 0; y < 97; ++y) {
    for (int x = 0; x < 97; ++x) {
      const double dx = x - 48.0, dy = y - 48.0, wide = std::pow(0.3F * scale, 2) + low_pass,
                   high = std::pow(double(0.1F) * scale, 2) + low_pass, q = dx * dx / wide + dy * dy / high;
      const double alpha = q < 9.0 ? double(0.8F) * std::exp(-0.5 * q) : 0.0;
      inside += q < 9.0 ? 1 : 0;
      const std::array<double, 4> expected{0.25 * alpha, 0.5 * alpha, 1.5 * alpha, alpha};
      for (int c = 0; c < 4; ++c)
        worst = std::max(worst, std::abs(double(image.pixel(x, y)[c]) - expected[static_cast<std::size_t>(c)]));
    }
  }
  figure("pixels inside", inside);
  figure("worst difference", worst);
  EXPECT_GT(inside, 500);
  EXPECT_LT(worst, 1e-6);
}

// Two over one another, and as many as complete a pixel.
TEST(GoldenGaussians, NearerOnesDimFartherOnesUntilAPixelIsFinished) {
  GaussianCloud cloud;
  for (int i = 0; i < 8; ++i) {  // larger y is nearer
    const double own = i == 7 ? 0.9 : 0.5;
    add(cloud, {.position = glm::vec3(0.0F, static_cast<float>(i), 0.0F), .scale = glm::vec3(1.0F), .opacity = 0.9F},
        {own, 0.1 * i, 0.0});
  }
  const auto scene = scene_of(cloud, view(31));
  const auto projected = scene::project_all(scene);
  ASSERT_EQ(projected.front().number, 7U);
  std::uint64_t samples = 0;
  const Image image = render_gaussians(scene, projected, {.samples = &samples});
  double transmittance = 1.0, red = 0.0, green = 0.0;
  int taken = 0;
  for (int i = 7; i >= 0 && transmittance >= 1e-4; --i, ++taken) {
    const double alpha = 0.9F;  // in the middle of the picture
    red += transmittance * alpha * (i == 7 ? 0.9 : 0.5);
    green += transmittance * alpha * 0.1 * i;
    transmittance *= 1.0 - alpha;
  }
  const float* const pixel = image.pixel(15, 15);
  figure("Gaussians until finished", taken);
  EXPECT_EQ(taken, 5) << "0.1^4 is a little more than 1e-4 in floats of 0.9";
  EXPECT_NEAR(double(pixel[0]), red, 1e-6);
  EXPECT_NEAR(double(pixel[1]), green, 1e-6);
  EXPECT_NEAR(double(pixel[3]), 1.0 - transmittance, 1e-7);
  EXPECT_GT(samples, 1000U);
}

// Two flat Gaussians that cross: their centres give one order for all pixels, but the true order varies by pixel.
TEST(GoldenGaussians, CrossingOnesAreInFrontWhereTheyAreNearer) {
  const float half = static_cast<float>(std::sqrt(0.5));
  GaussianCloud cloud;
  const float turn = static_cast<float>(std::sin(std::atan(1.0) / 2.0)),
              rest = static_cast<float>(std::cos(std::atan(1.0) / 2.0));
  add(cloud,
      {.position = glm::vec3(0.0F),
       .scale = glm::vec3(1.0F, 0.01F, 0.5F),
       .rotation = {rest, 0, 0, turn},
       .opacity = 0.99F},
      {1.0, 0.0, 0.0});
  add(cloud,
      {.position = glm::vec3(0.0F, 0.02F, 0.0F),
       .scale = glm::vec3(1.0F, 0.01F, 0.5F),
       .rotation = {rest, 0, 0, -turn},
       .opacity = 0.99F},
      {0.0, 1.0, 0.0});
  const auto scene = scene_of(cloud, view(81));
  const auto projected = scene::project_all(scene);
  const Image centres = render_gaussians(scene, projected);
  const Image pixels = render_gaussians(scene, projected, {.order = GaussianOrder::Pixels});
  const auto redder = [](const Image& image, int x) { return image.pixel(x, 40)[0] > image.pixel(x, 40)[1]; };
  EXPECT_FALSE(redder(centres, 25));
  EXPECT_FALSE(redder(centres, 55));
  EXPECT_NE(redder(pixels, 25), redder(pixels, 55)) << "half of each is in front";
  EXPECT_GT(half, 0.7F);
}

TEST(GoldenGaussians, CostOfTheOrderOfCentres) {
  for (const char* name : {"shells:2000", "cloud:500"}) {
    auto description = view(256, scene::Projection::Perspective);
    description.camera.azimuth = 30.0, description.camera.elevation = 15.0;
    const auto scene = scene_of(scene::make_synthetic_gaussians(name), description);
    const auto projected = scene::project_all(scene);
    std::uint64_t by_centres = 0, by_pixels = 0;
    const Image centres = render_gaussians(scene, projected, {.samples = &by_centres});
    const Image pixels = render_gaussians(scene, projected, {.order = GaussianOrder::Pixels, .samples = &by_pixels});
    const double apart = psnr(centres, pixels);
    figure(std::string(name) + ": order of centres against order at pixels", apart, "dB");
    // Opacity does not depend on the order, except where a pixel is completed.
    double alpha = 0.0;
    for (std::size_t i = 3; i < centres.data.size(); i += 4)
      alpha = std::max(alpha, std::abs(double(centres.data[i]) - double(pixels.data[i])));
    figure(std::string(name) + ": largest difference of opacity", alpha);
    EXPECT_LT(alpha, 1.01e-4);
    EXPECT_GT(apart, 30.0);
    EXPECT_LT(apart, 80.0) << "the other order must change something";
    EXPECT_GT(by_centres, 100000U);
    EXPECT_GT(by_pixels, 100000U);
  }
}

// Opacity is cut to 0.99 before the kernel, not after: the cost if every Gaussian is opaque.
TEST(GoldenGaussians, CostOfTheCapBeforeTheKernel) {
  GaussianCloud cloud = scene::make_synthetic_gaussians("cloud:500");
  for (Gaussian& one : cloud.gaussians) one.opacity = 1.0F;
  const auto scene = scene_of(cloud, view(256, scene::Projection::Perspective));
  auto projected = scene::project_all(scene);
  const Image before = render_gaussians(scene, projected);
  for (auto& splat : projected) splat.opacity = 1.0;
  const Image after = render_gaussians(scene, projected, {.cap_samples = true});
  figure("all opaque: cap before against cap after the kernel", psnr(before, after), "dB");
  const auto widest =
      std::ranges::max_element(projected, {}, [](const auto& splat) { return splat.shape.determinant(); });
  const Image alone = render_gaussians(scene, {*widest}, {.cap_samples = true});
  float most = 0.0F;
  for (std::size_t i = 3; i < alone.data.size(); i += 4) most = std::max(most, alone.data[i]);
  EXPECT_EQ(most, 0.99F) << "the most that one sample hides";
  EXPECT_GT(psnr(before, after), 50.0);
  EXPECT_LT(psnr(before, after), 100.0);
}

TEST(GoldenGaussians, ThreadsAndBandsNeverShow) {
  const auto scene = scene_of(scene::make_synthetic_gaussians("cloud:300"), view(100, scene::Projection::Perspective));
  const auto projected = scene::project_all(scene);
  for (const GaussianOrder order : {GaussianOrder::Centres, GaussianOrder::Pixels})
    EXPECT_EQ(render_gaussians(scene, projected, {.threads = 1, .order = order}),
              render_gaussians(scene, projected, {.threads = 3, .order = order}));
}

}  // namespace
}  // namespace fastsplat::golden
