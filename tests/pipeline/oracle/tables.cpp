// SPDX-License-Identifier: Apache-2.0
#include "tests/pipeline/oracle/tables.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fastsplat::stages::oracle {

int grid_bits(const cmodel::Config& config) {
  using cmodel::IndexKind;
  const bool computed = config.index() == IndexKind::Linear || config.index() == IndexKind::Squared ||
                        config.index() == IndexKind::SquaredElliptic;
  return computed ? config.position_frac_bits : static_cast<int>(std::lround(std::log2(config.phases)));
}

Scale scale_of(double v) {
  const int h = std::min(62, std::max(0, 23 - static_cast<int>(std::floor(std::log2(v)))));
  return {std::min(16777216.0, std::ceil(std::ldexp(v, h))), h};
}

namespace {

/// Section 4.1: even in distance, the sum by area preserved.
std::vector<double> linear_table(double a, double kernel_radius, const cmodel::Config& config) {
  const int entries = config.radial_entries;
  std::vector<double> words, remainders;
  double missing = 0.0;
  for (int t = 0; t < entries; ++t) {
    const double middle = (t + 0.5) / entries;
    const double f =
        std::ldexp(std::exp(-a * kernel_radius * kernel_radius * (middle * middle)), config.radial_frac_bits);
    words.push_back(std::floor(f));
    remainders.push_back(f - std::floor(f));
    missing += (f - std::floor(f)) * (2.0 * t + 1.0);
  }
  std::vector<std::size_t> order(words.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t left, std::size_t right) { return remainders[left] > remainders[right]; });
  for (const std::size_t t : order) {
    const double area = 2.0 * static_cast<double>(t) + 1.0;
    if (missing < area / 2.0) continue;
    words[t] += 1.0;
    missing -= area;
  }
  for (double& word : words) {
    word =
        std::min(std::ldexp(word, -config.radial_frac_bits), largest(config.radial_int_bits, config.radial_frac_bits));
  }
  return words;
}

}  // namespace

double line_end(double a, double kernel_radius, const cmodel::Config& config, int t) {
  const double fall = a * kernel_radius * kernel_radius, x = fall / (2.0 * config.radial_entries);
  return std::tanh(x) / x * std::exp(-fall * (static_cast<double>(t) / config.radial_entries));
}

std::vector<double> radial_table(double a, double kernel_radius, const cmodel::Config& config) {
  if (config.index() == cmodel::IndexKind::Linear) return linear_table(a, kernel_radius, config);
  const int entries = config.radial_entries;
  std::vector<double> words, remainders;
  double sum = 0.0;
  for (int t = 0; t < entries + config.radial_interpolate; ++t) {
    const double f = config.interpolates() ? line_end(a, kernel_radius, config, t)
                                           : std::exp(-a * kernel_radius * kernel_radius * ((t + 0.5) / entries));
    const double scaled = std::ldexp(f, config.radial_frac_bits);
    sum += scaled;
    words.push_back(std::floor(scaled));
    remainders.push_back(scaled - std::floor(scaled));
  }
  const double missing = std::floor(sum + 0.5) - std::accumulate(words.begin(), words.end(), 0.0);
  std::vector<std::size_t> order(words.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t left, std::size_t right) { return remainders[left] > remainders[right]; });
  for (std::size_t i = 0; i < order.size() && static_cast<double>(i) < missing; ++i) words[order[i]] += 1.0;
  for (double& word : words) {
    word =
        std::min(std::ldexp(word, -config.radial_frac_bits), largest(config.radial_int_bits, config.radial_frac_bits));
  }
  return words;
}

std::vector<double> factor_table(const cmodel::Config& config) {
  Closeness unused;
  std::vector<double> table{1.0};
  for (int j = 1; j <= config.opacity_segments; ++j) {
    const double tau = std::ldexp(static_cast<double>(j), config.sheet_int_bits) / config.opacity_segments;
    table.push_back(rnd(-std::expm1(-tau) / tau, config.opacity_frac_bits, unused));
  }
  return table;
}

double interpolated(const std::vector<double>& factor, double tau, const cmodel::Config& config, Closeness& closeness) {
  const double range = std::ldexp(1.0, config.sheet_int_bits);
  if (tau <= 0.0) return factor.front();
  if (tau >= range) return factor.back();
  const double segments = tau / range * config.opacity_segments;
  const double i = std::floor(segments);
  const double high = factor[static_cast<std::size_t>(i)], low = factor[static_cast<std::size_t>(i) + 1];
  return high - to_unit(config.rounding_fall, (high - low) * (segments - i), config.opacity_frac_bits, closeness);
}

// N-8-60.
double Shown::operator()(double word) {
  if (word >= 256.0) return word;
  const auto found = known_.find(word);
  if (found != known_.end()) return found->second;
  Closeness unused;
  double shown = 0.0, all = 0.0;
  for (std::size_t t = 0; t < radial_.size(); ++t) {
    const bool half = config_.interpolates() && (t == 0 || t + 1 == radial_.size());
    const double area = half                                           ? 0.5
                        : config_.index() == cmodel::IndexKind::Linear ? 2.0 * static_cast<double>(t) + 1.0
                                                                       : 1.0;
    shown += area * to_unsigned(config_.rounding_product, std::ldexp(word, -config_.colour_frac_bits) * radial_[t],
                                config_.sheet_int_bits, config_.sheet_frac_bits, unused);
    all += area * radial_[t];
  }
  // Sums of words: both are exact.
  const double value = all == 0.0 ? word : std::ldexp(shown, config_.colour_frac_bits) / all;
  known_[word] = value;
  return value;
}

// N-8-25, N-8-27, N-8-28.
RadiusSets::RadiusSets(const scene::Scene& scene, const cmodel::Config& config) {
  const volume::Volume& volume = *scene.volume;
  double most = 0.0;
  least_ = HUGE_VAL;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at =
        volume.position((corner & 1) != 0 ? volume.dims.x - 1 : 0, (corner & 2) != 0 ? volume.dims.y - 1 : 0,
                        (corner & 4) != 0 ? volume.dims.z - 1 : 0);
    const double r = scene.kernel.radius() * volume.kernel_unit() * scene.camera.project(at).scale;
    least_ = std::min(least_, r);
    most = std::max(most, r);
  }
  if (most <= least_ * (1.0 + 1e-9)) {
    radii_ = {most};
    return;
  }
  const double grid = std::ldexp(1.0, grid_bits(config));
  const double extent = std::ceil(2.0 * std::ceil(most * grid) / grid);
  const double columns = std::ceil(extent / config.lanes) * config.lanes;
  const bool by_phase = grid_bits(config) == static_cast<int>(std::lround(std::log2(config.phases))) &&
                        config.index() != cmodel::IndexKind::Linear && config.index() != cmodel::IndexKind::Squared &&
                        config.index() != cmodel::IndexKind::SquaredElliptic;
  const double room = by_phase ? std::floor(config.rlut_columns / columns) : HUGE_VAL;
  const double n = std::min(room, static_cast<double>(config.rlut_sets));
  b_ = n / std::log(most / least_);
  for (int i = 0; i < static_cast<int>(n); ++i) radii_.push_back(least_ * std::exp((i + 0.5) / b_));
}

double RadiusSets::of(double r, Closeness& closeness) const {
  if (radii_.size() == 1) return radii_.front();
  const double bin = trn(std::log(r / least_) * b_, 0, closeness);
  return radii_[static_cast<std::size_t>(cut(bin, 0.0, static_cast<double>(radii_.size()) - 1.0))];
}

}  // namespace fastsplat::stages::oracle
