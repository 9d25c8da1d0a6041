// One small legal stream with every kind of record, for tests that break it.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::test {

/// P = 2, 8 x 8 tiles, k = 2, three radius sets, tables of 4 and 3 words.
cmodel::Config small_stream_config();

/// Two tiles, three sheets (one empty), three splats, one cull_block. Its beats:
/// - 0 begin_frame 16 x 8, 2 tiles · 1-2 RLUT set 1 (rho 2, base 2, 4 words) · 3-4 RADIAL · 5-6 FACTOR
/// - 7 begin_tile 0 · 8 begin_sheet 3 · 9 splat · 10 cull_block · 11 splat · 12 end_sheet
/// - 13 begin_sheet 5 · 14 end_sheet · 15 end_tile
/// - 16 begin_tile 1 (x 8, sum) · 17 begin_sheet 0 · 18 splat · 19 end_sheet · 20 end_tile · 21 end_frame
std::vector<std::uint8_t> small_stream();

}  // namespace fastsplat::test
