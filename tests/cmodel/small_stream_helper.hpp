// SPDX-License-Identifier: Apache-2.0
// Small streams: a legal one with every kind of record, for tests that break it, and one with given tables.
#pragma once

#include <cstdint>
#include <map>
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

/// Words of tables by load_table's number.
using LoadedTables = std::map<int, std::vector<std::uint32_t>>;
/// One empty tile of 8 x 8 pixels, with RADIAL and FACTOR of zeros and with these tables.
std::vector<std::uint8_t> stream_with_tables(const cmodel::Config& config, int mode, const LoadedTables& tables);

}  // namespace fastsplat::test
