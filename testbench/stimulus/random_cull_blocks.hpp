// SPDX-License-Identifier: Apache-2.0
// Random cull_blocks that keep the stream invariant, for devices that cull (docs/stream.md, S-cull-3).
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stream_document.hpp"

namespace fastsplat::testbench {

/// Adds cull_blocks to the sheet: most are rectangles around the splats they cover; some are wider, empty or beside the
/// tile. `rho` by radius set, 1/k pixel.
void add_cull_blocks(const cmodel::Config& config, Random& random, const cmodel::BeginTile& tile,
                     const std::array<std::uint32_t, 256>& rho, SheetDocument& sheet);

}  // namespace fastsplat::testbench
