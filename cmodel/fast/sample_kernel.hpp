// Compositing every sample of whole footprints with vector instructions (Highway): docs/numerics.md, section 6, modes 4
// and 5.
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
  std::uint32_t heaviest = 0;         ///< no weight is larger, shifted as they are
};

/// What samples add to the counters of the same names.
struct SampleCounts {
  std::uint64_t frozen = 0, opacity_saturated = 0, composite_saturated = 0;
};

/// Composites the footprints one after the other; none reaches beyond the tile. The picture has words C_R, C_G, C_B
/// (U 1.tf) and T (One.tf) a pixel, `row` pixels from one row to the next; pixels behind a row's columns are written as
/// they were, up to pitch_of(columns).
void composite_samples(const SampleTables& tables, bool exponential, std::span<const SplatJob> jobs,
                       std::uint32_t* picture, std::size_t row, SampleCounts& counts);

}  // namespace fastsplat::cmodel::fast
