// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/noise.hpp"

#include <array>
#include <cmath>

namespace fastsplat::volume {
namespace {

std::uint32_t mixed(std::uint32_t word) {  // the 32-bit finaliser of MurmurHash3
  word = (word ^ word >> 16) * 0x85ebca6bu;
  word = (word ^ word >> 13) * 0xc2b2ae35u;
  return word ^ word >> 16;
}

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }
double blend(double a, double b, double t) { return a + (b - a) * t; }

}  // namespace

std::uint32_t hash_of(int x, int y, int z, std::uint32_t seed) {
  std::uint32_t word = mixed(seed ^ 0x9e3779b9u);
  for (const int number : {x, y, z}) word = mixed(word * 0x01000193u + static_cast<std::uint32_t>(number));
  return word;
}

double random_at(int x, int y, int z, std::uint32_t seed) { return hash_of(x, y, z, seed) / 4294967296.0; }

double smooth_noise(double x, double y, double z, std::uint32_t seed) {
  const std::array<double, 3> at{x, y, z};
  std::array<int, 3> cell{};
  std::array<double, 3> t{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double floor = std::floor(at[axis]);
    cell[axis] = static_cast<int>(floor);
    t[axis] = smooth(at[axis] - floor);
  }
  const auto row = [&](int dy, int dz) {
    return blend(random_at(cell[0], cell[1] + dy, cell[2] + dz, seed),
                 random_at(cell[0] + 1, cell[1] + dy, cell[2] + dz, seed), t[0]);
  };
  return blend(blend(row(0, 0), row(1, 0), t[1]), blend(row(0, 1), row(1, 1), t[1]), t[2]);
}

double fractal_noise(double x, double y, double z, int octaves, std::uint32_t seed) {
  double sum = 0.0;
  double amplitude = 1.0;
  double total = 0.0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude * smooth_noise(x, y, z, seed + static_cast<std::uint32_t>(octave));
    total += amplitude;
    amplitude *= 0.5;
    x *= 2.0, y *= 2.0, z *= 2.0;
  }
  return sum / total;
}

}  // namespace fastsplat::volume
