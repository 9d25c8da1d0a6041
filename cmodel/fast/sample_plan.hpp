// SPDX-License-Identifier: Apache-2.0
// Whether and how samples can be composited exactly in lanes of 32 bits, proved from the configuration alone.
#pragma once

#include <cstdint>
#include <optional>

#include "cmodel/fast/fast_plan.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel::fast {

/// value -> (value + bias) >> dropped.
struct Rounded {
  std::uint32_t bias = 0;
  int dropped = 0;
};

/// The narrowings from a sample to light (docs/numerics.md, sections 5 and 6), with colours and weights shifted as in
/// FastPlan. Transmittance and opacity are at most 1.0 = `one`. Their product is below 2^32 except for 1.0 times 1.0.
/// Where colours may exceed 1.0 (`wide`), so may their product with transmittance.
struct SamplePlan {
  Rounded product;  ///< U si.sf
  Rounded added;    ///< additive: product, with `grown` bits added, to tf fraction bits
  int grown = 0;
  Rounded fall;                     ///< of the slab factor, One.of
  int segment_bits = 0;             ///< b: bits of tau within a segment
  Rounded slab;                     ///< exponential: 64-bit product times factor, to tf fraction bits
  Rounded light;
  std::uint32_t one = 0, most = 0;  ///< 1.0 as One.tf; the largest word of the picture's colours
  bool wide = false;                ///< colours may exceed 1.0
  std::uint32_t most_slab = 0;      ///< the largest word of a slab's colour; `one` unless `wide`
  std::uint32_t freeze_below = 0;
};

/// Empty if only the plain unit is exact; `why_not`, if given, is then set to the reason.
std::optional<SamplePlan> sample_plan(const Config& config, const FastPlan& plan, const char** why_not = nullptr);

}  // namespace fastsplat::cmodel::fast
