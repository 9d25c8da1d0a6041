// SPDX-License-Identifier: Apache-2.0
// Solid patterns: range, continuity, noise as its definition, no effect at amplitude 0.
#include "scene/solid_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scene/solid_texture.hpp"

namespace fastsplat::scene {
namespace {

constexpr SolidKind kKinds[] = {SolidKind::Stripes, SolidKind::Marble, SolidKind::Wood, SolidKind::Noise,
                                SolidKind::Checker};

glm::dvec3 somewhere(std::mt19937& random, double reach) {
  const auto uniform = [&] { return reach * (2.0 * (random() / 4294967296.0) - 1.0); };
  const double x = uniform(), y = uniform();
  return {x, y, uniform()};
}

TEST(SolidField, StaysWithinZeroAndOneAndUsesMostOfIt) {
  for (const SolidKind kind : kKinds) {
    std::mt19937 random(1);
    double low = 1.0, high = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double value = solid_field(kind, somewhere(random, 50.0));
      low = std::min(low, value);
      high = std::max(high, value);
    }
    const char* name = solid_kind_names()[static_cast<std::size_t>(kind)].c_str();
    std::printf("[figure] %s_range = %.3f..%.3f (within 0..1, at least 0.2..0.8)\n", name, low, high);
    EXPECT_GE(low, 0.0) << name;
    EXPECT_LE(high, 1.0) << name;
    EXPECT_LT(low, 0.2) << name;
    EXPECT_GT(high, 0.8) << name;
  }
}

TEST(SolidField, SmoothKindsHaveTheGradientTheySay) {
  // A step of 1e-3 along a direction changes the field by the gradient's share. The gradient is a difference over 1/64,
  // which blunts steep parts (marble's veins) and rounds the kinks of the wood's rings: 10 % in the mean.
  constexpr double kStep = 1e-3;
  for (const SolidKind kind : kKinds) {
    if (kind == SolidKind::Checker) continue;
    std::mt19937 random(2);
    double error = 0.0, change = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 p = somewhere(random, 20.0);
      const glm::dvec3 way = kStep * glm::normalize(somewhere(random, 1.0));
      const double actual = solid_field(kind, p + way) - solid_field(kind, p - way);
      error += std::abs(actual - 2.0 * glm::dot(solid_gradient(kind, p), way));
      change += std::abs(actual);
    }
    std::printf("[figure] %s_gradient_error = %.4f (limit 0.1)\n",
                solid_kind_names()[static_cast<std::size_t>(kind)].c_str(), error / change);
    EXPECT_LE(error, 0.1 * change);
  }
}

TEST(GradientNoise, IsZeroOnTheLatticeAndSmoothBetween) {
  std::mt19937 random(3);
  double sum = 0.0, square = 0.0, most = 0.0, jump = 0.0;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec3 p = somewhere(random, 1000.0);
    ASSERT_EQ(gradient_noise(glm::floor(p)), 0.0);
    const double value = gradient_noise(p);
    sum += value, square += value * value, most = std::max(most, std::abs(value));
    // Across a face of the lattice, where two polynomials meet.
    const glm::dvec3 face(std::floor(p.x), p.y, p.z), beside(1e-9, 0.0, 0.0);
    jump = std::max(jump, std::abs(gradient_noise(face + beside) - gradient_noise(face - beside)));
  }
  std::printf(
      "[figure] noise_mean = %.4f (0 +- 0.01), rms = %.3f, largest = %.3f (limit 1), jump = %.2g (limit 1e-8)\n",
      sum / kSamples, std::sqrt(square / kSamples), most, jump);
  EXPECT_NEAR(sum / kSamples, 0.0, 0.01);
  EXPECT_GT(std::sqrt(square / kSamples), 0.2);
  EXPECT_LE(most, 1.0);
  EXPECT_LE(jump, 1e-8);
}

// N-8-108. The same on every platform: eight values computed independently (Python integers and doubles).
TEST(GradientNoise, IsTheSameEverywhere) {
  EXPECT_NEAR(gradient_noise({9.83, 19.34, 23.62}), 0.495765109326027, 1e-13);
  EXPECT_NEAR(gradient_noise({35.4, 19.19, 33.79}), 0.17870459311794, 1e-13);
  EXPECT_NEAR(gradient_noise({-37.68, -2.75, 35.47}), -0.18680582217179, 1e-13);
  EXPECT_NEAR(gradient_noise({11.92, 32.07, -30.94}), 0.0138030839262766, 1e-13);
  EXPECT_NEAR(gradient_noise({-2.47, -20.27, 3.5}), -0.180398620011753, 1e-13);
  EXPECT_NEAR(gradient_noise({5.92, -38.95, -22.66}), -0.128266883315167, 1e-13);
  EXPECT_NEAR(gradient_noise({-17.64, 33.31, 21.26}), 0.401853166939016, 1e-13);
  EXPECT_NEAR(gradient_noise({-27.23, 23.77, -28.9}), -0.134979060992077, 1e-13);
}

// N-8-106: the amplitude.
TEST(Tint, AmplitudeBlendsFromWhite) {
  std::mt19937 random(4);
  for (const SolidKind kind : kKinds) {
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 p = somewhere(random, 50.0);
      EXPECT_EQ(tint({.kind = kind, .scale = 3.0, .amplitude = 0.0}, p), glm::dvec3(1.0));
      const glm::dvec3 full = tint({.kind = kind, .scale = 3.0, .amplitude = 1.0}, p);
      const glm::dvec3 half = tint({.kind = kind, .scale = 3.0, .amplitude = 0.5}, p);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(half[c], 0.5 * (1.0 + full[c]), 1e-15);
        EXPECT_GE(full[c], 0.0);
        EXPECT_LE(full[c], 1.0);
      }
    }
  }
}

}  // namespace
}  // namespace fastsplat::scene
