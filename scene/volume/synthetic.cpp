// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/synthetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "scene/volume/landscape.hpp"

namespace fastsplat::volume {
namespace {

/// Voxel value from its index; every generator is such a function of (i,j,k) and the edge length n.
using Generator = float (*)(int i, int j, int k, int n);

/// -1..1 across the volume.
double across(int index, int n) { return 2.0 * index / (n - 1) - 1.0; }

/// Marschner and Lobb 1994: frequency 6, amplitude 0.25, on [-1,1]^3.
float marschner_lobb(int i, int j, int k, int n) {
  constexpr double kFrequency = 6.0;
  constexpr double kAmplitude = 0.25;
  constexpr double kPi = std::numbers::pi;
  const double r = std::hypot(across(i, n), across(j, n));
  const double wave = std::cos(2.0 * kPi * kFrequency * std::cos(0.5 * kPi * r));
  const double value =
      (1.0 - std::sin(0.5 * kPi * across(k, n)) + kAmplitude * (1.0 + wave)) / (2.0 * (1.0 + kAmplitude));
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

/// Three concentric soft shells of value 1, 2/3 and 1/3 from the inside out; exactly 0 between them.
float shells(int i, int j, int k, int n) {
  constexpr std::array<std::array<double, 2>, 3> kShells{
      {{0.30, 1.0}, {0.60, 2.0 / 3.0}, {0.88, 1.0 / 3.0}}};  // radius, value
  constexpr double kHalfThickness = 0.09;
  const double r = std::sqrt(across(i, n) * across(i, n) + across(j, n) * across(j, n) + across(k, n) * across(k, n));
  for (const auto& [radius, value] : kShells) {
    const double t = std::abs(r - radius) / kHalfThickness;
    if (t < 1.0) return static_cast<float>(value * (1.0 - t * t) * (1.0 - t * t));
  }
  return 0.0f;
}

/// 1 in the middle half of every axis, else 0.
float binary_cube(int i, int j, int k, int n) {
  const auto inside = [n](int index) { return 4 * index >= n && 4 * (n - 1 - index) >= n; };
  return inside(i) && inside(j) && inside(k) ? 1.0f : 0.0f;
}

constexpr int kTile = 2;  // voxels along a checkerboard square

float checker(int a, int b) { return (a / kTile + b / kTile) % 2 == 0 ? 1.0f : 0.5f; }

/// The two lowest layers: squares of 1 and 0.5; 0 above.
float checkerboard_floor(int i, int j, int k, int) { return k < kTile ? checker(i, j) : 0.0f; }

/// Four walls, two voxels thick, along y: squares of 1 and 0.5; 0 inside.
float checkerboard_tunnel(int i, int j, int k, int n) {
  const auto wall = [n](int index) { return std::min(index, n - 1 - index) < kTile; };
  if (wall(k)) return checker(i, j);
  return wall(i) ? checker(k, j) : 0.0f;
}

float constant(int, int, int, int) { return 1.0f; }

/// One voxel of 1 at index n/2 of every axis.
float point(int i, int j, int k, int n) { return i == n / 2 && j == n / 2 && k == n / 2 ? 1.0f : 0.0f; }

/// 1 in the middle layer of z, else 0.
float layer(int, int, int k, int n) { return k == n / 2 ? 1.0f : 0.0f; }

/// Two neighbours along x in the middle of the grid, of value 0.5 and 1.
float pair(int i, int j, int k, int n) {
  if (j != n / 2 || k != n / 2) return 0.0f;
  return i == n / 2 - 1 ? 0.5f : i == n / 2 ? 1.0f : 0.0f;
}

struct Entry {
  const char* name;
  int default_size;
  Generator generate;
};

constexpr std::array<Entry, 11> kEntries{{{"marschner-lobb", 64, marschner_lobb},
                                          {"shells", 64, shells},
                                          {"binary-cube", 32, binary_cube},
                                          {"checkerboard-floor", 128, checkerboard_floor},
                                          {"checkerboard-tunnel", 64, checkerboard_tunnel},
                                          {"constant", 32, constant},
                                          {"point", 9, point},
                                          {"layer", 24, layer},
                                          {"pair", 4, pair},
                                          {"terrain", 128, terrain},
                                          {"fire", 64, fire}}};

const Entry& find(const std::string& name) {
  for (const auto& entry : kEntries) {
    if (name == entry.name) return entry;
  }
  throw_input({.where = {},
               .what = "unknown built-in volume '" + name + "'",
               .expected = {},
               .got = {},
               .fix = suggestion(name, synthetic_names())});
}

}  // namespace

Volume describe_synthetic(const std::string& name, int size) {
  const Entry& entry = find(name);
  if (size < 2 || size > 1024) {
    throw_input({.where = name,
                 .what = "size is out of range",
                 .expected = "2..1024 voxels along an edge",
                 .got = fmt::format("{}", size),
                 .fix = fmt::format("for example {}:{}", name, entry.default_size)});
  }
  Volume volume;
  volume.name = fmt::format("{}:{}", name, size);
  volume.built_in = true;
  volume.source = fmt::format("built-in {}, {} voxels along an edge", name, size);
  volume.dims = glm::ivec3(size);
  volume.stored = VoxelType::F32;
  return volume;
}

Volume make_synthetic(const std::string& name, int size) {
  Volume volume = describe_synthetic(name, size);
  const Entry& entry = find(name);
  volume.voxels.resize(static_cast<std::size_t>(size) * size * size);
  auto voxel = volume.voxels.begin();
  for (int k = 0; k < size; ++k) {
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) *voxel++ = entry.generate(i, j, k, size);
    }
  }
  const auto [low, high] = std::minmax_element(volume.voxels.begin(), volume.voxels.end());
  volume.min = *low;
  volume.max = *high;
  return volume;
}

std::vector<std::string> synthetic_names() {
  std::vector<std::string> names;
  for (const auto& entry : kEntries) names.emplace_back(entry.name);
  return names;
}

int default_synthetic_size(const std::string& name) { return find(name).default_size; }

}  // namespace fastsplat::volume
