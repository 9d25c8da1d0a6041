// SPDX-License-Identifier: Apache-2.0
// Unit "RLUT": squared distance along one axis, per radius set, window phase and column (N-4-1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

class Rlut {
 public:
  explicit Rlut(const Config& config);

  /// Loads a checked load_table record.
  void load(const LoadTable& table);

  std::uint32_t rho(std::uint32_t set) const { return sets_[set].rho; }
  /// Footprint extent in pixels, a multiple of P.
  std::uint32_t extent(std::uint32_t set) const { return sets_[set].extent; }

  /// P consecutive columns of a set, starting at `column` (a multiple of P): one axis of one window.
  std::span<const std::uint32_t> read(std::uint32_t set, std::uint32_t phase, std::uint32_t column) const {
    const std::size_t first = static_cast<std::size_t>(phase) * columns_ + sets_[set].base + column;
    return {words_.data() + first, lanes_};
  }

 private:
  struct Set {
    std::uint32_t rho = 0, base = 0, extent = 0;
  };
  std::size_t columns_, lanes_;
  std::uint32_t phases_;
  std::vector<Set> sets_;
  std::vector<std::uint32_t> words_;  ///< [phase][column]
};

}  // namespace fastsplat::cmodel
