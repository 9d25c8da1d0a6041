// SPDX-License-Identifier: Apache-2.0
// Unit "footprint": the P x P weights of one window (docs/numerics.md, sections 4 and 4.7). One adder and one table
// read per lane; interpolation takes a second word and a multiplier.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/lane.hpp"

namespace fastsplat::cmodel {

/// Radial table, indexed by scaled squared distance.
class RadialTable {
 public:
  explicit RadialTable(const Config& config)
      : guard_bits_(config.rlut_guard_bits),
        entries_(static_cast<std::size_t>(config.radial_entries)),
        rest_(config.interpolates() ? (std::uint32_t{1} << guard_bits_) - 1 : 0),
        weights_(static_cast<std::size_t>(config.radial_words()), 0),
        fall_(config) {}

  void load(std::span<const std::uint32_t> words) { weights_.assign(words.begin(), words.end()); }

  /// Weight (U wi.wf) at q, in steps of 2^-g entries, such as the sum of two RLUT words; 0 at and beyond the rim.
  template <class Observer>
  std::uint32_t weight(std::uint64_t q, Observer& observer) const {
    return at(q >> guard_bits_, q, observer);
  }
  /// The same at index t. Of `steps` only the g bits that interpolation reads matter, so higher bits may be missing.
  template <class Observer>
  std::uint32_t at(std::uint64_t index, std::uint64_t steps, Observer& observer) const {
    if (index >= entries_) return 0;
    const std::uint32_t weight = weights_[index];
    const auto rest = static_cast<std::int64_t>(steps & rest_);
    if (rest == 0) return weight;
    const std::int64_t fall = std::int64_t{weight} - weights_[index + 1];
    return static_cast<std::uint32_t>(weight - fall_(fall * rest, observer));
  }

 private:
  int guard_bits_;
  std::size_t entries_;
  std::uint64_t rest_;  ///< mask of q's bits between two entries; 0: no interpolation
  std::vector<std::uint32_t> weights_;
  NarrowAt<Site::RadialFall> fall_;
};

/// Fills weights[j*P+i] from the columns' and rows' RLUT words of one window.
template <class Observer>
void footprint(const RadialTable& radial, std::span<const std::uint32_t> columns, std::span<const std::uint32_t> rows,
               std::span<std::uint32_t> weights, Observer& observer) {
  std::size_t lane = 0;
  for (const std::uint32_t row : rows) {
    for (const std::uint32_t column : columns) weights[lane++] = radial.weight(std::uint64_t{row} + column, observer);
  }
}

}  // namespace fastsplat::cmodel
