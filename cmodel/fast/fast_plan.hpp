// SPDX-License-Identifier: Apache-2.0
// Whether and how the fast unit can draw a configuration exactly, proved from its numbers alone (docs/performance.md).
#pragma once

#include <cstdint>
#include <optional>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel::fast {

/// How products and sums of a configuration are computed in lanes of 16 or 32 bits. If there is a plan, no product
/// leaves the sheet's format.
struct FastPlan {
  bool narrow = false;  ///< 16-bit lanes: round(colour << colour_shift times weight << weight_shift, 15 bits dropped)
  int colour_shift = 0, weight_shift = 0;
  int dropped_bits = 0;           ///< 32-bit lanes: (colour times weight + bias) >> dropped_bits
  std::uint32_t bias = 0;         ///< of 32-bit lanes
  bool carries = false;           ///< 32-bit lanes: sums may wrap so soon that every addition is checked for a carry
  std::uint32_t largest_sum = 0;  ///< of the sheet's format; larger sums saturate

  // Sums of hidden splats are bounded from above in lanes of 16 bits, in units of 2^hidden_unit of the sheet's. Colours
  // are shifted right by hidden_shift (left if negative) and rounded up, so that no product is too small.
  bool hides = false;
  int hidden_unit = 0, hidden_shift = 0;
};

/// Empty if only the plain unit is exact: products wider than 32 bits or above the sheet's format, ties to even,
/// cull.map = pixel, or more than 64 blocks in a tile's row. `why_not`, if given, is then set to the reason.
std::optional<FastPlan> fast_plan(const Config& config, const char** why_not = nullptr);

}  // namespace fastsplat::cmodel::fast
