// SPDX-License-Identifier: Apache-2.0
// Composites every sample of whole footprints with vector instructions (Highway): modes 4 and 5 (N-6-12).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/fast/row_kernel.hpp"
#include "cmodel/fast/sample_plan.hpp"

namespace fastsplat::cmodel::fast {

struct SampleTables {
  SamplePlan plan;
  std::vector<std::uint32_t> factor;  ///< G+1 words One.of
  std::uint32_t heaviest = 0;         ///< largest shifted weight
};

/// Whether every slab of a footprint is below 1.0; `brightest`: the largest word of its shifted colour.
inline bool is_small(const SampleTables& tables, std::uint64_t brightest) {
  // Of additive slabs. The factor of exponential ones is at most 1.0, and both round alike.
  const auto rounded = [](std::uint64_t value, const Rounded& how) { return (value + how.bias) >> how.dropped; };
  const SamplePlan& plan = tables.plan;
  return rounded(rounded(brightest * tables.heaviest, plan.product) << plan.grown, plan.added) < plan.one;
}

/// Contributions to frozen_pixels, opacity_saturated and composite_saturated.
struct SampleCounts {
  std::uint64_t frozen = 0, opacity_saturated = 0, composite_saturated = 0;
};

/// Composites the footprints one after the other; none reaches beyond the tile. A pixel of the picture has the words
/// C_R, C_G, C_B (U 1+ci.tf) and T (One.tf); rows are `row` pixels apart. Pixels after a footprint's columns, up to
/// pitch_of(columns), are written unchanged.
void composite_samples(const SampleTables& tables, bool exponential, std::span<const SplatJob> jobs,
                       std::uint32_t* picture, std::size_t row, SampleCounts& counts);

}  // namespace fastsplat::cmodel::fast
