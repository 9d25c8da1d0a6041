// SPDX-License-Identifier: Apache-2.0
#include "analysis/index_kinds/family_cost.hpp"

#include <bit>
#include <cmath>

#include "cmodel/numbers/index_set.hpp"
#include "cmodel/numbers/window_geometry.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

std::uint32_t rho_of(const cmodel::Config& config, int radius) {
  return static_cast<std::uint32_t>(radius * config.grid());
}

/// Bits of a word 0..most.
int bits_of(std::int64_t most) { return std::bit_width(static_cast<std::uint64_t>(most)); }

std::uint64_t weight_bits(const cmodel::Config& config) {
  return static_cast<std::uint64_t>(config.radial_int_bits + config.radial_frac_bits);
}

}  // namespace

bool has_radial_table(IndexKind kind) { return kind != IndexKind::Blit2d && kind != IndexKind::Separable; }

Operations operations(const cmodel::Config& config, int radius) {
  // One multiply and one add belong to product and sheet, for every kind.
  switch (config.index()) {
    case IndexKind::Linear: {
      const double squared = 2.0 * std::pow(static_cast<double>(radius) * config.grid(), 2);
      const int bits = static_cast<int>(std::ceil(std::log2(squared))) + 2 * config.rlut_guard_bits;
      return {.adds = 3, .multiplies = 2, .reads = 1, .root_steps = (bits + 1) / 2, .formula = "E^2"};
    }
    case IndexKind::Squared:
    case IndexKind::SquaredElliptic:
      return {.adds = 3, .multiplies = 1, .reads = 1, .root_steps = 0, .formula = "E ceil(E/P)"};
    case IndexKind::Blit2d:
      return {.adds = 1, .multiplies = 1, .reads = 1, .root_steps = 0, .formula = "ceil(E/P)^2"};
    case IndexKind::Separable:
      return {.adds = 1, .multiplies = 2, .reads = 0, .root_steps = 0, .formula = "ceil(E/P)^2"};
    case IndexKind::Rlut:
      break;
  }
  return {.adds = 2, .multiplies = 1, .reads = 1, .root_steps = 0, .formula = "ceil(E/P)^2"};
}

std::uint64_t storage_bits(const cmodel::Config& config, int radius) {
  std::uint64_t bits = 0;
  const auto words = static_cast<std::size_t>(cmodel::set_words(config, rho_of(config, radius)));
  for (std::size_t word = 0; word < (config.has_phases() ? 1 : words); ++word) {
    const auto range = cmodel::set_word_range(config, word);
    const auto width = static_cast<std::uint64_t>(bits_of(range.most) + (range.least < 0 ? 1 : 0));
    bits += width * (config.has_phases() ? words : 1);  // words by phase are all alike
  }
  if (has_radial_table(config.index())) bits += static_cast<std::uint64_t>(config.radial_words()) * weight_bits(config);
  return bits;
}

double predicted_bits(const cmodel::Config& config, int radius) {
  const double b = static_cast<double>(weight_bits(config)), k = config.grid(), E = 2.0 * radius + 1.0;
  const double table = config.radial_entries * b;
  switch (config.index()) {
    case IndexKind::Blit2d:
      return k * k * E * E * b;
    case IndexKind::Rlut:
      return k * E * 2.0 * std::ceil(std::log2(k * radius)) + table;
    case IndexKind::Separable:
      return k * E * b;
    case IndexKind::Linear:
    case IndexKind::Squared:
    case IndexKind::SquaredElliptic:
      break;
  }
  return table;
}

std::uint64_t cycles_per_splat(const cmodel::Config& config, int radius) {
  const auto geometry = cmodel::window_geometry(config, rho_of(config, radius));
  const std::uint64_t extent = geometry.extent, windows = geometry.windows;
  if (config.has_phases()) return windows * windows;
  return extent * (config.index() == IndexKind::Linear ? extent : windows);
}

double predicted_snap_rms(const cmodel::Config& config, double voxel) { return 255.0 * 0.27 / (voxel * config.grid()); }

double predicted_index_max(const cmodel::Config& config) {
  if (!has_radial_table(config.index())) return 0.0;
  return 255.0 * (config.index() == IndexKind::Linear ? 1.213 : 4.0) / config.radial_entries;
}

}  // namespace fastsplat::analysis
