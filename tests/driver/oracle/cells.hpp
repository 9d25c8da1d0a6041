// SPDX-License-Identifier: Apache-2.0
// A sheet's splats in groups, written again from docs/numerics.md, section 8, "Sets", alone: which cells of the screen
// become which groups.
#pragma once

#include <cstdint>
#include <vector>

namespace fastsplat::scene_oracle {

/// A W x H tile in square cells.
struct Cells {
  std::int64_t side = 0, columns = 0, rows = 0;
};
Cells cells_of(std::int64_t P, std::int64_t W, std::int64_t H);

struct CellSet {
  std::int64_t x = 0, y = 0, width = 0, height = 0;  ///< pixels
  std::vector<std::size_t> cells;
};
struct SheetCells {
  std::vector<CellSet> sets;
  std::vector<std::size_t> others;  ///< with candidates, in no group
};
/// For candidates by cell, each of `windows` windows. `may_hide`: the tile has two sheets before this one. `widest`: Ea
/// of the widest radius set.
SheetCells sheet_cells(const Cells& cells, const std::vector<std::int64_t>& candidates, std::int64_t windows,
                       bool may_hide, std::int64_t widest);

}  // namespace fastsplat::scene_oracle
