// SPDX-License-Identifier: Apache-2.0
// The built-in scene `outdoor` has the statistics of docs/techniques/gaussians.md; seeds of built-in scenes.
#include "scene/gaussians/synthetic_gaussians.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/error.hpp"
#include "base/parallel/parallel.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/projected_gaussian.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

/// Standard errors that an estimate may be off.
constexpr double kErrors = 4.0;
constexpr int kCount = 100'000;

const GaussianCloud& outdoor() {
  static const GaussianCloud cloud = make_synthetic_gaussians("outdoor:" + std::to_string(kCount));
  return cloud;
}

void print_value(const char* name, double value) { std::printf("[figure] %s = %.4g\n", name, value); }

bool in_sky(const Gaussian& one) { return glm::length(one.position) > 50.0F; }

/// Share of the Gaussians for which `holds` is true.
template <class Holds>
double share_of(const GaussianCloud& cloud, const Holds& holds) {
  return static_cast<double>(std::ranges::count_if(cloud.gaussians, holds)) /
         static_cast<double>(cloud.gaussians.size());
}

void expect_share(const char* name, double share, double expected) {
  print_value(name, share);
  EXPECT_NEAR(share, expected, kErrors * std::sqrt(expected * (1.0 - expected) / kCount)) << name;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

TEST(Outdoor, SharesAreAsStated) {
  expect_share("share of the sky", share_of(outdoor(), in_sky), 0.15);
  expect_share("share of opacities below 0.1",
               share_of(outdoor(), [](const Gaussian& one) { return one.opacity < 0.1F; }), 0.45);
  expect_share("share of opacities above 0.9",
               share_of(outdoor(), [](const Gaussian& one) { return one.opacity > 0.9F; }), 0.20);
  const auto [least, most] = std::ranges::minmax(outdoor().gaussians, {}, &Gaussian::opacity);
  EXPECT_GE(least.opacity, 0.005F);
  EXPECT_LE(most.opacity, 1.0F);
}

// Medians and quartiles of logarithms. Their standard errors are those of a normal distribution: 1.25 and, of the
// distance of quartiles, 1.57 deviations over sqrt(n). Quartiles of the sum of 12 uniform numbers are at 0.682.
TEST(Outdoor, ScalesAreLogNormalAndAnisotropic) {
  std::vector<double> longest, wide, thin;
  for (const Gaussian& one : outdoor().gaussians) {
    ASSERT_GE(one.scale.x, one.scale.y);
    ASSERT_GE(one.scale.y, one.scale.z);
    ASSERT_GT(one.scale.z, 0.0F);
    if (in_sky(one)) longest.push_back(std::log(one.scale.x));  // the same median everywhere
    wide.push_back(std::log(one.scale.x / one.scale.y));
    thin.push_back(std::log(one.scale.y / one.scale.z));
  }
  const double root = std::sqrt(kCount), sky = std::sqrt(static_cast<double>(longest.size()));
  print_value("median of longest / middle", std::exp(quantile(wide, 0.5)));
  print_value("median of middle / shortest", std::exp(quantile(thin, 0.5)));
  EXPECT_NEAR(quantile(wide, 0.5), 1.57, kErrors * 1.25 * 0.73 / root);
  EXPECT_NEAR(quantile(thin, 0.5), 1.16, kErrors * 1.25 * 0.97 / root);
  EXPECT_NEAR(quantile(longest, 0.75) - quantile(longest, 0.25), 2.0 * 0.682 * 0.55, kErrors * 1.57 * 0.55 / sky);
}

TEST(Outdoor, HarmonicsDecayAndFewColoursExceedOne) {
  ASSERT_EQ(outdoor().degree, 3);
  std::array<double, 4> squares{};
  std::uint64_t bright = 0;
  const glm::dvec3 eye(0.0, -5.5, 1.5);
  for (std::size_t i = 0; i < outdoor().gaussians.size(); ++i) {
    const auto harmonics = outdoor().harmonics_of(i);
    for (std::size_t k = 1; k < harmonics.size(); ++k)
      squares[k < 4 ? 1 : k < 9 ? 2 : 3] += glm::dot(glm::dvec3(harmonics[k]), glm::dvec3(harmonics[k])) / 3.0;
    const glm::dvec3 colour = colour_at(harmonics, glm::normalize(glm::dvec3(outdoor().gaussians[i].position) - eye));
    bright += std::max({colour.x, colour.y, colour.z}) > 1.0 ? 1 : 0;
  }
  constexpr std::array<double, 4> kExpected{0.0, 0.08, 0.05, 0.03};
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    const double count = kCount * (2.0 * static_cast<double>(degree) + 1.0);
    // Squares of these sums of two uniform numbers deviate by less than their mean.
    EXPECT_NEAR(std::sqrt(squares[degree] / count) / kExpected[degree], 1.0, kErrors / std::sqrt(count)) << degree;
  }
  const double share = static_cast<double>(bright) / kCount;
  print_value("share of colours above 1", share);
  EXPECT_GT(share, 0.0);
  EXPECT_LT(share, 0.01);
}

TEST(Outdoor, LeavesRoomForCameras) {
  for (const Gaussian& one : outdoor().gaussians) {
    const float away = glm::length(glm::vec2(one.position));
    if (in_sky(one)) continue;
    EXPECT_GE(one.position.z, -0.12F);
    EXPECT_FALSE(away > 4.5F && away < 7.0F && one.position.z > 0.12F) << one.position.x << ' ' << one.position.y;
  }
}

// Progress is reported for every part, by every thread.
TEST(Outdoor, ProjectionReportsProgress) {
  GaussianDescription description;
  description.width = 64, description.height = 36;
  description.up = UpAxis::Z;
  const auto scene = build_gaussian_scene(description, std::make_shared<GaussianCloud>(outdoor()));
  std::atomic<std::size_t> calls{0}, most{0};
  const auto splats = project_all(scene, nullptr, 2, [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, part_count(kCount));
    ++calls;
    if (done == total) most = done;
  });
  EXPECT_GT(splats.size(), 0U);
  EXPECT_GT(calls, 1U);
  EXPECT_EQ(calls, part_count(kCount));
  EXPECT_EQ(most, part_count(kCount));
}

TEST(SyntheticGaussians, SeedsDecideTheScene) {
  const auto hash = [](const char* name) { return content_hash(make_synthetic_gaussians(name)); };
  EXPECT_EQ(hash("outdoor:500"), hash("outdoor:500:1"));
  EXPECT_EQ(hash("cloud:200"), hash("cloud:200:63"));
  EXPECT_NE(hash("outdoor:500:1"), hash("outdoor:500:2"));
  EXPECT_NE(hash("cloud:200:1"), hash("cloud:200:2"));
  EXPECT_EQ(make_synthetic_gaussians("outdoor:50:1").name, "outdoor:50");
  EXPECT_EQ(make_synthetic_gaussians("outdoor:50:18446744073709551615").name, "outdoor:50:18446744073709551615");
}

TEST(SyntheticGaussians, RefuseWhatIsNotACountAndASeed) {
  const auto refused = [](const char* name, const char* said) {
    EXPECT_THAT([&] { make_synthetic_gaussians(name); }, ::testing::ThrowsMessage<UserError>(HasSubstr(said)));
  };
  for (const char* name : {"outdoor:10:", "outdoor:10:x", "outdoor:10:-1", "outdoor:10:1:2", "cloud:10:1.5"})
    refused(name, "the seed is not a number");
  for (const char* name : {"outdoor:", "outdoor::1", "outdoor:0", "outdoor:10000001", "outdoor:x:1", "shells:10:1"})
    refused(name, "the number of Gaussians is out of range (expected 1..10000000");
}

}  // namespace
}  // namespace fastsplat::scene
