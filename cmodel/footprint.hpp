// Unit "footprint": the P x P weights of one window (docs/numerics.md, section 4). One adder and one table read per
// lane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/config.hpp"
#include "cmodel/lane.hpp"

namespace fastsplat::cmodel {

/// Radial table, indexed by scaled squared distance.
class RadialTable {
 public:
  explicit RadialTable(const Config& config)
      : guard_bits_(config.rlut_guard_bits), weights_(static_cast<std::size_t>(config.radial_entries), 0) {}

  void load(std::span<const std::uint32_t> words) { weights_.assign(words.begin(), words.end()); }

  /// Weight (U wi.wf) at q = sum of two RLUT words; 0 at and beyond the rim.
  std::uint32_t weight(std::uint32_t q) const { return at(radial_index(q, guard_bits_)); }
  /// Weight at index t; 0 past the table's end.
  std::uint32_t at(std::uint64_t index) const { return index < weights_.size() ? weights_[index] : 0; }

 private:
  int guard_bits_;
  std::vector<std::uint32_t> weights_;
};

/// weights[j*P+i] for the columns' and rows' RLUT words of one window.
inline void footprint(const RadialTable& radial, std::span<const std::uint32_t> columns,
                      std::span<const std::uint32_t> rows, std::span<std::uint32_t> weights) {
  std::size_t lane = 0;
  for (const std::uint32_t row : rows) {
    for (const std::uint32_t column : columns) weights[lane++] = radial.weight(row + column);
  }
}

}  // namespace fastsplat::cmodel
