// SPDX-License-Identifier: Apache-2.0
#include "scene/textured_splats.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/volume/noise.hpp"

namespace fastsplat::scene {
namespace {

constexpr std::uint32_t kSeed = 1993;
constexpr int kOctaves = 2;
constexpr double kDrawnOut = 2.0;           // stretch along v, the direction in which it rises
constexpr double kContrast = 3.0;           // of the noise about its middle, before clamping to 0..1
constexpr double kSamplesPerFeature = 6.0;  // of the finest octave
constexpr int kMostSamples = 256;           // along a side

int wrapped(int index, int period) { return (index % period + period) % period; }
double smooth(double t) { return t * t * (3.0 - 2.0 * t); }
double blend(double a, double b, double t) { return a + (b - a) * t; }

/// Value noise that repeats after `rows` in y and after `times` in t.
double cyclic_noise(double x, double y, double t, int rows, int times, std::uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y), ft = std::floor(t);
  const auto corner = [&](int dx, int dy, int dt) {
    return volume::random_at(static_cast<int>(fx) + dx, wrapped(static_cast<int>(fy) + dy, rows),
                             wrapped(static_cast<int>(ft) + dt, times), seed);
  };
  const double sx = smooth(x - fx), sy = smooth(y - fy), st = smooth(t - ft);
  const auto plane = [&](int dt) {
    return blend(blend(corner(0, 0, dt), corner(1, 0, dt), sx), blend(corner(0, 1, dt), corner(1, 1, dt), sx), sy);
  };
  return blend(plane(0), plane(1), st);
}

struct Grid {
  int side;
  double radius;

  double place(int index) const { return radius * (2.0 * index / (side - 1) - 1.0); }
  std::size_t count() const { return static_cast<std::size_t>(side) * side; }
};

/// Noise that rises (towards smaller v) by one period per cycle and changes. The cycle's end equals its beginning.
std::vector<double> rising_noise(const Grid& grid, double scale, int phase, int phases) {
  const double along = kDrawnOut * scale;
  const int period = static_cast<int>(std::ceil(2.0 * grid.radius / along)) + 1;
  const int times = std::max(2, phases / 4);
  const double progress = static_cast<double>(phase) / phases;
  std::vector<double> samples(grid.count(), 0.0);
  double amplitude = 1.0;
  double total = 0.0;
  for (int octave = 0; octave < kOctaves; ++octave, amplitude *= 0.5) {
    const int finer = 1 << octave;
    total += amplitude;
    for (int y = 0; y < grid.side; ++y) {
      for (int x = 0; x < grid.side; ++x) {
        samples[static_cast<std::size_t>(y) * grid.side + x] +=
            amplitude * cyclic_noise(finer * grid.place(x) / scale, finer * (grid.place(y) / along + period * progress),
                                     times * progress, finer * period, times, kSeed + octave);
      }
    }
  }
  for (double& sample : samples) sample = std::clamp(0.5 + kContrast * (sample / total - 0.5), 0.0, 1.0);
  return samples;
}

/// Subtracts the phases' mean at each place and each phase's mean under the footprint; scales the largest to 1.
void balance(std::vector<std::vector<double>>& phases, const Grid& grid, const Kernel& kernel) {
  for (std::size_t i = 0; i < grid.count(); ++i) {
    double sum = 0.0;
    for (const auto& phase : phases) sum += phase[i];
    for (auto& phase : phases) phase[i] -= sum / static_cast<double>(phases.size());
  }
  std::vector<double> weights(grid.count());
  double total = 0.0;
  for (int y = 0; y < grid.side; ++y) {
    for (int x = 0; x < grid.side; ++x) {
      double& weight = weights[static_cast<std::size_t>(y) * grid.side + x];
      weight = kernel.footprint(grid.place(x) * grid.place(x) + grid.place(y) * grid.place(y));
      total += weight;
    }
  }
  double largest = 0.0;
  for (auto& phase : phases) {
    double mean = 0.0;
    for (std::size_t i = 0; i < grid.count(); ++i) mean += weights[i] * phase[i];
    mean /= total;
    for (double& sample : phase) {
      sample -= mean;
      largest = std::max(largest, std::abs(sample));
    }
  }
  for (auto& phase : phases) {
    for (double& sample : phase) sample /= largest;
  }
}

}  // namespace

double TexturePhase::operator()(double u, double v) const {
  const double to_index = 0.5 * (side_ - 1) / radius_;
  const double x = std::clamp((u + radius_) * to_index, 0.0, static_cast<double>(side_ - 1));
  const double y = std::clamp((v + radius_) * to_index, 0.0, static_cast<double>(side_ - 1));
  const int left = std::min(static_cast<int>(x), side_ - 2);
  const int top = std::min(static_cast<int>(y), side_ - 2);
  const double* row = &samples_[static_cast<std::size_t>(top) * side_ + left];
  return blend(blend(row[0], row[1], x - left), blend(row[side_], row[side_ + 1], x - left), y - top);
}

TexturedSplats::TexturedSplats(const SplatTexture& settings, const Kernel& kernel)
    : amplitude_(settings.amplitude), frame_(static_cast<unsigned>(settings.frame)) {
  if (!(amplitude_ > 0.0)) return;
  const double finest = settings.scale / (1 << (kOctaves - 1));
  const Grid grid{
      std::min(static_cast<int>(std::ceil(kSamplesPerFeature * 2.0 * kernel.radius() / finest)), kMostSamples),
      kernel.radius()};
  std::vector<std::vector<double>> phases;
  for (int phase = 0; phase < settings.phases; ++phase)
    phases.push_back(rising_noise(grid, settings.scale, phase, settings.phases));
  balance(phases, grid, kernel);
  for (auto& samples : phases) phases_.emplace_back(grid.side, grid.radius, std::move(samples));
}

std::size_t TexturedSplats::number_of(const glm::vec3& position) const {
  if (phases_.empty()) return 0;
  const std::uint32_t hash = volume::hash_of(std::bit_cast<int>(position.x), std::bit_cast<int>(position.y),
                                             std::bit_cast<int>(position.z), kSeed);
  return (std::uint64_t{hash} + frame_) % phases_.size();
}

}  // namespace fastsplat::scene
