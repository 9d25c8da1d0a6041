// What of a configuration lets samples be composited in lanes of 32 bits, proved from its numbers alone.
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

/// How a sample becomes light (docs/numerics.md, sections 5 and 6) where colours and weights are shifted as FastPlan
/// says. Transmittance and opacity are at most 1.0 = `one`, and their product is below 2^32 but for 1.0 times 1.0.
struct SamplePlan {
  Rounded product;  ///< U si.sf
  Rounded added;    ///< additive: product to One.tf, behind `grown` bits more
  int grown = 0;
  Rounded fall;                     ///< of the slab factor, One.of
  int segment_bits = 0;             ///< b: of tau, those within a segment
  Rounded slab;                     ///< exponential: product times factor to One.tf, of 64 bits
  Rounded light;                    ///< One.tf
  std::uint32_t one = 0, most = 0;  ///< as One.tf; the largest word U 1.tf
  std::uint32_t freeze_below = 0;
};

/// Empty where only the plain unit is exact; `why_not`, where given, is then set to words that say why.
std::optional<SamplePlan> sample_plan(const Config& config, const FastPlan& plan, const char** why_not = nullptr);

}  // namespace fastsplat::cmodel::fast
