// SPDX-License-Identifier: Apache-2.0
#include "scene/solid_field.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace fastsplat::scene {
namespace {

/// A bijection of 32-bit words; changing one input bit flips about half of the output bits.
std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

std::uint32_t hash(std::uint32_t i, std::uint32_t j, std::uint32_t k) { return mix(i + mix(j + mix(k))); }

/// Dot product of `offset` from a lattice point with one of the twelve directions to a cube's edges.
double slope(std::uint32_t lattice_hash, const glm::dvec3& offset) {
  const std::uint32_t edge = lattice_hash % 12;
  const double first = edge < 4 ? offset.y : offset.x;
  const double second = edge < 8 ? offset.z : offset.y;
  return (edge & 1 ? -first : first) + (edge & 2 ? -second : second);
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

/// Octaves of halved size and weight, in [-1,1].
double octaves(glm::dvec3 p, int count) {
  double sum = 0.0, weight = 1.0, total = 0.0;
  for (int i = 0; i < count; ++i) {
    sum += weight * gradient_noise(p);
    total += weight;
    weight *= 0.5;
    p = 2.0 * p + glm::dvec3(17.3, -5.9, 31.7);  // no two octaves share their lattice points
  }
  return sum / total;
}

double marble(const glm::dvec3& p) {
  constexpr double kStir = 1.6;  // in units of the veins' distance
  const double wave = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * (p.x + kStir * octaves(p, 4)));
  return 1.0 - std::pow(1.0 - wave, 3.0);  // wide ground, narrow veins
}

double wood(const glm::dvec3& p) {
  constexpr double kTilt = 0.12;
  const glm::dvec3 trunk(p.x + kTilt * p.z, p.y - 0.5 * kTilt * p.z, 0.15 * p.z);
  const double ring = std::hypot(trunk.x, trunk.y) + 0.35 * octaves(0.5 * trunk, 2);
  const double age = ring - std::floor(ring);  // slow growth of light wood, a quick fall to dark
  const double growth = age < 0.8 ? age / 0.8 : (1.0 - age) / 0.2;
  const double grain = 0.08 * gradient_noise(glm::dvec3(9.0 * p.x, 9.0 * p.y, p.z));
  return std::clamp(1.0 - growth * growth * (3.0 - 2.0 * growth) * 0.9 + grain, 0.0, 1.0);
}

}  // namespace

const std::vector<std::string>& solid_kind_names() {
  static const std::vector<std::string> names = {"none", "stripes", "marble", "wood", "noise", "checker"};
  return names;
}

const std::vector<std::string>& smooth_kind_names() {
  static const std::vector<std::string> names(solid_kind_names().begin(), solid_kind_names().end() - 1);
  return names;
}

double gradient_noise(const glm::dvec3& p) {
  const glm::dvec3 cell = glm::floor(p);
  const glm::dvec3 within = p - cell;
  std::array<std::uint32_t, 3> base{};
  for (int c = 0; c < 3; ++c) base[c] = static_cast<std::uint32_t>(static_cast<std::int64_t>(cell[c]));
  double corner[2][2][2];
  for (std::uint32_t k = 0; k < 2; ++k) {
    for (std::uint32_t j = 0; j < 2; ++j) {
      for (std::uint32_t i = 0; i < 2; ++i) {
        corner[k][j][i] = slope(hash(base[0] + i, base[1] + j, base[2] + k), within - glm::dvec3(i, j, k));
      }
    }
  }
  const double u = fade(within.x), v = fade(within.y), w = fade(within.z);
  const auto between = [](double t, double a, double b) { return a + t * (b - a); };
  const auto plane = [&](int k) {
    return between(v, between(u, corner[k][0][0], corner[k][0][1]), between(u, corner[k][1][0], corner[k][1][1]));
  };
  return between(w, plane(0), plane(1));
}

double solid_field(SolidKind kind, const glm::dvec3& p) {
  switch (kind) {
    case SolidKind::None:
      break;
    case SolidKind::Checker: {
      const glm::dvec3 cell = glm::floor(p);
      return std::fmod(std::abs(cell.x + cell.y + cell.z), 2.0);
    }
    case SolidKind::Stripes:
      return 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * p.x);
    case SolidKind::Marble:
      return marble(p);
    case SolidKind::Wood:
      return wood(p);
    case SolidKind::Noise:
      return std::clamp(0.5 + octaves(p, 4), 0.0, 1.0);
  }
  assert(false && "no pattern");
  return 0.0;
}

glm::dvec3 solid_gradient(SolidKind kind, const glm::dvec3& p) {
  assert(kind != SolidKind::None && kind != SolidKind::Checker);
  constexpr double kStep = 1.0 / 64;
  glm::dvec3 gradient;
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 step(0.0);
    step[c] = kStep;
    gradient[c] = (solid_field(kind, p + step) - solid_field(kind, p - step)) / (2.0 * kStep);
  }
  return gradient;
}

}  // namespace fastsplat::scene
