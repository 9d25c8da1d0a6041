// SPDX-License-Identifier: Apache-2.0
// Random legal streams, boundary cases first: ties, saturation, every window phase and bank, all tile edges, footprints
// wider than the lanes, overlapping radius sets, tables that no driver makes.
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

/// Places of cull_blocks for culling devices. Whole: never between the splats of a group, as a fetching source
/// requires.
enum class SetOrder { Any, Whole };

/// At least `splats` splat records (a few more: sheets are not cut short); with ellipse.frac_bits about half of them
/// are ellipses.
RandomStream random_stream(const oracle::Symbols& symbols, Random& random, std::uint64_t splats,
                           SetOrder sets = SetOrder::Any);

}  // namespace fastsplat::test
