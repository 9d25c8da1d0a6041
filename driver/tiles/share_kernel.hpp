// SPDX-License-Identifier: Apache-2.0
// Shares of many splats in one sheet (docs/numerics.md, N-8-44 to N-8-48), with vector instructions (Highway).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cmodel/fast/tile_unit.hpp"
#include "driver/splats/slices.hpp"

namespace fastsplat::driver {

/// A splat until its last sheet.
struct WaitingSplat {
  cmodel::fast::WaitingRecord record;
  SplatWords words;  ///< the whole splat
  std::int32_t depth, last_sheet;
};

/// A splat's share as the unit adds it.
struct SheetColour {
  std::array<std::uint16_t, 4> words;  ///< shifted left
  bool empty, saturated;
};

/// Slices::share(), or whole(), of each splat.
void share_out(const SheetCut& cut, int colour_shift, const WaitingSplat* splats, std::size_t count, SheetColour* out);

}  // namespace fastsplat::driver
