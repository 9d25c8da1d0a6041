// SPDX-License-Identifier: Apache-2.0
// Spherical harmonics against their closed formula: associated Legendre functions with the Condon-Shortley phase.
#include "scene/gaussians/harmonics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace fastsplat::scene {
namespace {

double factorial(unsigned n) { return std::tgamma(n + 1.0); }

/// Y_l^m of real harmonics. (std::assoc_legendre leaves the phase (-1)^m out.)
double closed_formula(int l, int m, double theta, double phi) {
  const auto degree = static_cast<unsigned>(l), order = static_cast<unsigned>(std::abs(m));
  const double norm =
      std::sqrt((2.0 * l + 1.0) / (4.0 * std::numbers::pi) * factorial(degree - order) / factorial(degree + order));
  const double legendre = (order % 2 == 1 ? -1.0 : 1.0) * std::assoc_legendre(degree, order, std::cos(theta));
  if (m == 0) return norm * legendre;
  return std::numbers::sqrt2 * norm * legendre * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi));
}

glm::dvec3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

TEST(Harmonics, AreTheClosedFormulas) {
  double worst = 0.0;
  int compared = 0;
  for (int a = 0; a <= 24; ++a) {
    for (int b = 0; b < 48; ++b) {
      const double theta = a * std::numbers::pi / 24.0, phi = b * std::numbers::pi / 24.0;
      const auto values = harmonics_at(direction(theta, phi));
      for (int l = 0, at = 0; l <= kMostDegree; ++l) {
        for (int m = -l; m <= l; ++m, ++at, ++compared)
          worst = std::max(worst, std::abs(values[static_cast<std::size_t>(at)] - closed_formula(l, m, theta, phi)));
      }
    }
  }
  std::printf("[figure] harmonics compared = %d\n[figure] worst difference = %.3g\n", compared, worst);
  EXPECT_GT(compared, 10000);
  EXPECT_LT(worst, 1e-14);
}

TEST(Harmonics, AreOrthonormal) {
  // Midpoint rule in phi (exact here) and Gauss's in cos(theta) by many midpoints.
  constexpr int kRings = 4000, kSteps = 16;
  std::array<std::array<double, 16>, 16> products{};
  for (int a = 0; a < kRings; ++a) {
    const double z = -1.0 + (2.0 * a + 1.0) / kRings, theta = std::acos(z);
    for (int b = 0; b < kSteps; ++b) {
      const auto values = harmonics_at(direction(theta, (b + 0.3) * 2.0 * std::numbers::pi / kSteps));
      for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = 0; j < 16; ++j)
          products[i][j] += values[i] * values[j] * (2.0 / kRings) * (2.0 * std::numbers::pi / kSteps);
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t j = 0; j < 16; ++j) worst = std::max(worst, std::abs(products[i][j] - (i == j ? 1.0 : 0.0)));
  std::printf("[figure] worst product off 0 or 1 = %.3g\n", worst);
  EXPECT_LT(worst, 1e-5);
}

TEST(Harmonics, AColourIsHalfMoreAndNeverBelowZero) {
  const std::vector<glm::vec3> constant{glm::vec3(1.0F, 0.0F, -5.0F)};
  const glm::dvec3 colour = colour_at(constant, {0.0, 0.0, 1.0});
  EXPECT_NEAR(colour.x, 0.5 + kConstantHarmonic, 1e-12);
  EXPECT_EQ(colour.y, 0.5);
  EXPECT_EQ(colour.z, 0.0);
  std::vector<glm::vec3> up(4, glm::vec3(0.0F));
  up[2].x = 0.5F;  // brighter seen along +z
  EXPECT_NEAR(colour_at(up, {0.0, 0.0, 1.0}).x - 0.5, 0.5 * std::sqrt(3.0 / (4.0 * std::numbers::pi)), 1e-12);
  EXPECT_LT(colour_at(up, {0.0, 0.0, -1.0}).x, 0.5);
}

}  // namespace
}  // namespace fastsplat::scene
