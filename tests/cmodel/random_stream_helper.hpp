// SPDX-License-Identifier: Apache-2.0
// Random legal streams, boundary cases first: ties, saturation, every window phase and bank, all tile edges, footprints
// wider than the lanes, overlapping radius sets, tables no driver would make.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/cmodel/oracle/symbols.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::test {

struct RandomStream {
  std::vector<std::uint8_t> bytes;
  std::uint64_t splats = 0;
};

/// Of devices that cull: where cull_blocks may stand. Whole: not between the splats of a set, as a fetching source
/// wants.
enum class SetOrder { Any, Whole };

/// At least `splats` splat records (a few more: sheets are not cut short); with ellipse.frac_bits about half of them
/// are ellipses.
RandomStream random_stream(const oracle::Symbols& symbols, Random& random, std::uint64_t splats,
                           SetOrder sets = SetOrder::Any);

}  // namespace fastsplat::test
