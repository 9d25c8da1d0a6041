// SPDX-License-Identifier: Apache-2.0
#include "driver/tables/tables.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cmodel/numbers/window_geometry.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/radius_sets.hpp"

namespace fastsplat::driver {
namespace {

/// Indices of the remainders, largest first; ties keep their order.
std::vector<std::size_t> by_remainder(const std::vector<double>& remainder) {
  std::vector<std::size_t> order(remainder.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return remainder[a] > remainder[b]; });
  return order;
}

/// Rounds each value down or up so that the words' sum is the rounded sum of the values. The largest remainders go up,
/// ties in order.
std::vector<std::uint32_t> quantise_preserving_sum(const std::vector<double>& values, const cmodel::Config& config) {
  const Target each = target(Site::Radial, config), total = target(Site::RadialSum, config);
  std::vector<std::uint32_t> words(values.size());
  std::vector<double> remainder(values.size());
  double sum = 0.0;
  std::int64_t floor_sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double scaled = std::ldexp(values[i], each.to.frac_bits);
    words[i] = quantise_to<std::uint32_t>(values[i], each);
    remainder[i] = scaled - words[i];
    sum += scaled;
    floor_sum += words[i];
  }
  const auto order = by_remainder(remainder);
  const auto raise = static_cast<std::size_t>(quantise(sum, total).word - floor_sum);
  for (std::size_t i = 0; i < raise && i < order.size(); ++i) ++words[order[i]];
  return words;
}

/// The same where word t stands for a ring of area 2t+1. The words' sum by area is that of the values to within half of
/// the last ring.
std::vector<std::uint32_t> quantise_preserving_area(const std::vector<double>& values, const cmodel::Config& config) {
  const Target each = target(Site::Radial, config);
  const auto area = [](std::size_t t) { return 2.0 * static_cast<double>(t) + 1.0; };
  std::vector<std::uint32_t> words(values.size());
  std::vector<double> remainder(values.size());
  double missing = 0.0;
  for (std::size_t t = 0; t < values.size(); ++t) {
    words[t] = quantise_to<std::uint32_t>(values[t], each);
    remainder[t] = std::ldexp(values[t], each.to.frac_bits) - words[t];
    missing += remainder[t] * area(t);
  }
  for (const std::size_t t : by_remainder(remainder)) {
    if (missing < area(t) / 2.0) continue;
    ++words[t];
    missing -= area(t);
  }
  return words;
}

/// Whether the radial samples are even in distance, not in its square.
bool even_in_distance(const cmodel::Config& config) { return config.index() == cmodel::IndexKind::Linear; }

}  // namespace

cmodel::LoadTable rlut_table(const cmodel::Config& config, std::uint32_t set, double radius, std::uint32_t base) {
  const int k = config.phases;
  const double rim_distance = radius * k;  // 1/k pixel
  const std::uint32_t rho = support_radius(radius, config);
  const cmodel::WindowGeometry geometry = cmodel::window_geometry(config, rho);
  const auto padded = static_cast<int>(geometry.padded);
  const Target scaled = target(Site::Rlut, config);

  cmodel::LoadTable table{.table = cmodel::Table::Rlut, .radius = {.set = set, .rho = rho, .base = base}, .words = {}};
  table.words.reserve(static_cast<std::size_t>(k) * padded);
  for (int m = 0; m < k; ++m) {
    for (int i = 0; i < padded; ++i) {
      const double d = static_cast<double>(std::int64_t{i + 1} * k - m) - rho;
      table.words.push_back(rlut_word(d, rim_distance, scaled));
    }
  }
  return table;
}

std::vector<double> radial_samples(const cmodel::Config& config, const scene::Kernel& kernel) {
  const double fall = kernel.a() * kernel.radius() * kernel.radius();
  std::vector<double> samples(static_cast<std::size_t>(config.radial_words()));
  if (config.interpolates()) {
    const double half = fall / (2.0 * config.radial_entries), scale = std::tanh(half) / half;
    for (std::size_t t = 0; t < samples.size(); ++t)
      samples[t] = scale * std::exp(-fall * (static_cast<double>(t) / config.radial_entries));
    return samples;
  }
  for (std::size_t t = 0; t < samples.size(); ++t) {
    const double middle = (static_cast<double>(t) + 0.5) / static_cast<double>(samples.size());
    const double u = even_in_distance(config) ? middle * middle : middle;
    samples[t] = std::exp(-fall * u);
  }
  return samples;
}

cmodel::LoadTable radial_table(const cmodel::Config& config, const scene::Kernel& kernel) {
  const std::vector<double> samples = radial_samples(config, kernel);
  cmodel::LoadTable table{.table = cmodel::Table::Radial,
                          .radius = {},
                          .words = even_in_distance(config) ? quantise_preserving_area(samples, config)
                                                            : quantise_preserving_sum(samples, config)};
  const auto largest = static_cast<std::uint32_t>(config.weight_format().max);
  for (auto& word : table.words) word = std::min(word, largest);
  return table;
}

cmodel::LoadTable factor_table(const cmodel::Config& config) {
  const Target words = target(Site::Factor, config);
  cmodel::LoadTable table{.table = cmodel::Table::Factor, .radius = {}, .words = {}};
  for (int j = 0; j <= config.opacity_segments; ++j) {
    const double tau = std::ldexp(static_cast<double>(j), config.sheet_int_bits) / config.opacity_segments;
    const double factor = j == 0 ? 1.0 : -std::expm1(-tau) / tau;
    table.words.push_back(quantise_to<std::uint32_t>(factor, words));
  }
  return table;
}

double radial_area(const cmodel::Config& config, std::size_t t) {
  if (config.interpolates()) return t == 0 || t == static_cast<std::size_t>(config.radial_entries) ? 0.5 : 1.0;
  return even_in_distance(config) ? 2.0 * static_cast<double>(t) + 1.0 : 1.0;
}

std::vector<std::uint32_t> slice_table(const cmodel::Config& config, const scene::Kernel& kernel) {
  auto steps = static_cast<int>(std::ceil(std::ldexp(2.0 * kernel.radius(), config.slice_phase_bits)));
  steps += steps % 2;
  const Target weight = target(Site::Phi, config);
  std::vector<std::uint32_t> words;
  words.reserve(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i <= steps; ++i) {
    const double z = std::ldexp(static_cast<double>(i - steps / 2), -config.slice_phase_bits);
    words.push_back(quantise_to<std::uint32_t>(kernel.cumulative(z), weight));
  }
  words.front() = 0;
  words.back() = static_cast<std::uint32_t>(weight.to.max);
  return words;
}

}  // namespace fastsplat::driver
