// Random cull_blocks that are true, for devices that cull (docs/stream.md, cull_block).
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stream_document.hpp"

namespace fastsplat::testbench {

/// Puts cull_blocks among the sheet's splats: rectangles around those that each covers, now and then a wider one, one
/// of none, or one beside the tile. rho by radius set, 1/k pixel.
void promise(const cmodel::Config& config, Random& random, const cmodel::BeginTile& tile,
             const std::array<std::uint32_t, 256>& rho, SheetDocument& sheet);

}  // namespace fastsplat::testbench
