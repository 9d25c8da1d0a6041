// SPDX-License-Identifier: Apache-2.0
#include "tests/driver/oracle/cells.hpp"

#include <algorithm>

namespace fastsplat::scene_oracle {
namespace {

std::int64_t up(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

}  // namespace

/// N-8-75.
Cells cells_of(std::int64_t P, std::int64_t W, std::int64_t H) {
  std::int64_t side = P;
  while (up(W, side) * up(H, side) > 1024) side *= 2;
  return {side, up(W, side), up(H, side)};
}

SheetCells sheet_cells(const Cells& cells, const std::vector<std::int64_t>& candidates, std::int64_t windows,
                       bool may_hide, std::int64_t widest) {
  SheetCells out;
  for (std::int64_t y = 0; y < cells.rows; y += 2) {
    for (std::int64_t x = 0; x < cells.columns; x += 2) {
      // The square's cells by row; a tile's last may have fewer.
      std::vector<std::vector<std::size_t>> rows;
      for (std::int64_t row = y; row < std::min(y + 2, cells.rows); ++row) {
        rows.emplace_back();
        for (std::int64_t column = x; column < std::min(x + 2, cells.columns); ++column)
          rows.back().push_back(static_cast<std::size_t>(row * cells.columns + column));
      }
      std::vector<std::size_t> all;
      for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
      const auto sum = [&](const std::vector<std::size_t>& some) {
        std::int64_t splats = 0;
        for (const std::size_t cell : some) splats += candidates[cell];
        return splats;
      };
      // N-8-76.
      const auto enough = [&](const std::vector<std::size_t>& some) {
        return sum(some) == 0 || sum(some) * windows >= 100;
      };
      const auto filled = [&](const std::vector<std::size_t>& some) {
        std::vector<std::size_t> kept;
        for (const std::size_t cell : some)
          if (candidates[cell] > 0) kept.push_back(cell);
        return kept;
      };
      const auto add = [&](const std::vector<std::size_t>& some) {
        if (filled(some).empty()) return;
        const auto first = static_cast<std::int64_t>(some.front()), last = static_cast<std::int64_t>(some.back());
        // N-8-79: the rectangle.
        CellSet set{.x = first % cells.columns * cells.side,
                    .y = first / cells.columns * cells.side,
                    .width = (last % cells.columns - first % cells.columns + 1) * cells.side + widest - 1,
                    .height = (last / cells.columns - first / cells.columns + 1) * cells.side + widest - 1,
                    .cells = filled(some)};
        out.sets.push_back(std::move(set));
      };
      // N-8-78: the first test that holds.
      const bool each = std::ranges::all_of(all, [&](std::size_t cell) { return enough({cell}); });
      const bool by_row = std::ranges::all_of(rows, enough);
      if (may_hide && each) {
        for (const std::size_t cell : all) add({cell});
      } else if (may_hide && by_row) {
        for (const auto& row : rows) add(row);
      } else if (may_hide && enough(all)) {
        add(all);
      } else {
        const auto rest = filled(all);
        out.others.insert(out.others.end(), rest.begin(), rest.end());
      }
    }
  }
  return out;
}

}  // namespace fastsplat::scene_oracle
