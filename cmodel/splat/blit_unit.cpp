// SPDX-License-Identifier: Apache-2.0
#include "cmodel/splat/blit_unit.hpp"

#include <algorithm>
#include <utility>

#include "cmodel/numbers/index_set.hpp"

namespace fastsplat::cmodel {

StoredAxis stored_axis(const Config& config, std::uint32_t rho, std::uint32_t m) {
  const auto k = static_cast<std::uint32_t>(config.phases);
  if (config.index_symmetry == static_cast<int>(IndexSymmetry::Off)) return {.phase = m};
  // d(m,i) = (i+1) k - m - rho has its opposite at phase m', column (m + m' + 2 rho) / k - 2 - i (N-4.4-3).
  const auto image = [&](std::uint32_t phase) { return (2 * k - phase - 2 * rho % k) % k; };
  const std::uint32_t other = image(m), smaller = std::min(m, other);
  std::uint32_t number = 0;
  for (std::uint32_t phase = 0; phase < smaller; ++phase) number += phase <= image(phase) ? 1 : 0;
  if (smaller == m) return {.phase = number};
  return {.phase = number, .first = static_cast<std::int32_t>((m + other + 2 * rho) / k) - 2, .step = -1};
}

StoredFootprint stored_footprint(const Config& config, const StoredAxis& x, const StoredAxis& y) {
  if (config.index_symmetry == static_cast<int>(IndexSymmetry::Off))
    return {.number = y.phase * static_cast<std::uint32_t>(config.phases) + x.phase};
  const std::uint32_t most = std::max(x.phase, y.phase), least = std::min(x.phase, y.phase);
  return {.number = most * (most + 1) / 2 + least, .transposed = x.phase > y.phase};
}

void BlitUnit::place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y) {
  x_ = stored_axis(config_, rho(set), x.phase);
  y_ = stored_axis(config_, rho(set), y.phase);
  const StoredFootprint stored = stored_footprint(config_, x_, y_);
  transposed_ = stored.transposed;
  side_ = static_cast<std::int32_t>(extent(set));
  const std::size_t words = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  footprint_ = std::span<const std::uint32_t>(sets_[set]).subspan(stored.number * words, words);
}

std::uint32_t BlitUnit::weight(std::uint32_t i, std::uint32_t j) const {
  std::int32_t column = x_(i), row = y_(j);
  if (transposed_) std::swap(column, row);
  // The mirror image of a padded column may lie outside the footprint (N-4.4-5).
  if (column < 0 || row < 0 || column >= side_ || row >= side_) return 0;
  return footprint_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(column)];
}

}  // namespace fastsplat::cmodel
