// SPDX-License-Identifier: Apache-2.0
// Composites with vector instructions (Highway): every sample of whole footprints (modes 4 and 5, N-6-12), and the sums
// of sheets (modes 0 and 1).
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

/// Side by side blocks of `side` x `rows` pixels, and the sums of a sheet below them.
template <class T>
struct SumBlocks {
  std::uint64_t blocks = 0;  ///< a bit for each that is to be composited
  std::size_t side = 0, rows = 0;
  const T* sums = nullptr;           ///< of block 0's first pixel, four words each
  std::size_t sums_row = 0;          ///< pixels
  std::uint32_t* picture = nullptr;  ///< likewise, as in composite_samples()
  std::size_t picture_row = 0;
  std::uint32_t largest = 0;  ///< a larger sum may have been cut
};
struct CompositedBlocks {
  bool sound = true;             ///< false: a sum is above `largest`; the picture is then spoiled
  std::uint64_t terminated = 0;  ///< of the composited blocks, those all of whose pixels are terminated now
};
/// Whether a block of `side` pixels is whole vectors.
bool composites_sums(std::size_t side);
CompositedBlocks composite_sums(const SampleTables& tables, bool exponential, const SumBlocks<std::uint16_t>& of,
                                SampleCounts& counts);
CompositedBlocks composite_sums(const SampleTables& tables, bool exponential, const SumBlocks<std::uint32_t>& of,
                                SampleCounts& counts);

}  // namespace fastsplat::cmodel::fast
