// What of a configuration lets the fast unit draw it, proved from its numbers alone (docs/performance.md).
#pragma once

#include <cstdint>
#include <optional>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel::fast {

/// How products and sums of a configuration are done in lanes of 16 or 32 bits. With a plan, no product leaves the
/// sheet's format, whatever colour and weight.
struct FastPlan {
  bool narrow = false;  ///< 16-bit lanes: round(colour << colour_shift times weight << weight_shift, 15 bits dropped)
  int colour_shift = 0, weight_shift = 0;
  int dropped_bits = 0;    ///< 32-bit lanes: (colour times weight + bias) >> dropped_bits
  std::uint32_t bias = 0;  ///< likewise
  bool carries = false;    ///< 32-bit lanes: sums come round so soon that every carry out of a lane is looked for
  std::uint32_t largest_sum = 0;  ///< of the sheet's format; sums above it were cut

  // Hidden sums are bounded in lanes of 16 bits, in units of 2^hidden_unit of the sheet's. Each product is at least its
  // true value: of colours shifted right by hidden_shift (left if negative) and rounded up.
  bool hides = false;
  int hidden_unit = 0, hidden_shift = 0;
};

/// Empty where only the plain unit is exact: products wider than 32 bits or above the sheet's format, ties to even, or
/// more than 64 blocks in a tile's row. `why_not`, where given, is then set to words that say which.
std::optional<FastPlan> fast_plan(const Config& config, const char** why_not = nullptr);

}  // namespace fastsplat::cmodel::fast
