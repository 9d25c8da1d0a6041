// SPDX-License-Identifier: Apache-2.0
// Emits a sheet whose splats are in cull groups of screen cells, cull_blocks first (docs/numerics.md, N-8-54 to
// N-8-59).
#include <algorithm>
#include <vector>

#include "driver/tiles/compiled_state.hpp"

namespace fastsplat::driver {
namespace {

/// Least number of windows in a group: its cull_block then costs at most a hundredth of its splats (N-8-56).
constexpr std::uint64_t kWindowsOfASet = 100;
/// Sheets of a tile in which nothing can be hidden (N-8-57).
constexpr std::uint64_t kSheetsUnhidden = 2;

}  // namespace

SheetSets CompiledFrame::State::sheet_sets(int tile, int sheet, std::uint64_t written) const {
  const auto side = static_cast<std::uint64_t>(windows.narrowest() / config.lanes);
  std::vector<std::uint64_t> candidates(static_cast<std::size_t>(cells.count()));
  for (int cell = 0; cell < cells.count(); ++cell) {
    auto& of = candidates[static_cast<std::size_t>(cell)];
    for (int from = std::max(0, sheet - reach); from <= sheet; ++from)
      of += bins.cell(tile, from, cell).size() * side * side;
  }
  SheetSets out;
  // Whether the cells in columns x0..x1-1 and rows y0..y1-1 have enough candidates for one group, or none at all.
  const auto worth = [&](int x0, int y0, int x1, int y1) {
    std::uint64_t sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) sum += candidates[static_cast<std::size_t>(y * cells.columns() + x)];
    return sum == 0 || sum >= kWindowsOfASet;
  };
  const auto take = [&](int x0, int y0, int x1, int y1, bool as_set) {
    CellSet set;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const int cell = y * cells.columns() + x;
        if (candidates[static_cast<std::size_t>(cell)] > 0) (as_set ? set.cells : out.others).push_back(cell);
      }
    }
    if (set.cells.empty()) return;
    const int more = windows.widest() - 1;
    set.block.x = x0 * cells.side(), set.block.y = y0 * cells.side();
    set.block.width = (x1 - x0) * cells.side() + more, set.block.height = (y1 - y0) * cells.side() + more;
    out.sets.push_back(std::move(set));
  };
  for (int y = 0; y < cells.rows(); y += 2) {
    const int end = std::min(y + 2, cells.rows());
    for (int x = 0; x < cells.columns(); x += 2) {
      const int right = std::min(x + 2, cells.columns());
      bool singly = true, by_rows = true;
      for (int row = y; row < end; ++row) {
        by_rows = by_rows && worth(x, row, right, row + 1);
        for (int column = x; column < right; ++column) singly = singly && worth(column, row, column + 1, row + 1);
      }
      const bool all = worth(x, y, right, end), hides = written >= kSheetsUnhidden;
      if (!hides || !all || (!singly && !by_rows)) {
        take(x, y, right, end, hides && all);
        continue;
      }
      for (int row = y; row < end; ++row) {
        if (!singly) take(x, row, right, row + 1, true);
        for (int column = x; singly && column < right; ++column) take(column, row, column + 1, row + 1, true);
      }
    }
  }
  return out;
}

bool CompiledFrame::State::emit_sets(int tile, int sheet, std::uint32_t& tag, cmodel::RecordSink& out,
                                     TileReport& report) const {
  const std::int32_t x0 = grid.x(tile) * (1 << config.position_frac_bits),
                     y0 = grid.y(tile) * (1 << config.position_frac_bits);
  std::vector<cmodel::SplatRecord> records;
  const auto gather = [&](int cell) {
    for (int from = std::max(0, sheet - reach); from <= sheet; ++from) {
      for (const std::uint32_t number : bins.cell(tile, from, cell)) {
        const QuantisedSplat& splat = projected.splats[number];
        const Share part = share(number, sheet);
        if (part.empty()) continue;
        report.saturated_records += part.saturated ? 1 : 0;
        records.push_back({.set = splat.set, .tag = tag++, .x = splat.x - x0, .y = splat.y - y0, .colour = part.words});
      }
    }
  };
  const SheetSets split = sheet_sets(tile, sheet, report.sheets);
  std::vector<cmodel::CullBlock> blocks;
  if (!split.sets.empty()) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
  for (const CellSet& one : split.sets) {
    cmodel::CullBlock set = one.block;
    set.tag = tag;
    const std::size_t before = records.size();
    if (!out.would_hide(set)) std::ranges::for_each(one.cells, gather);
    set.splats = static_cast<std::uint32_t>(records.size() - before);
    blocks.push_back(set);
  }
  std::ranges::for_each(split.others, gather);
  if (split.sets.empty() && records.empty()) return false;
  if (split.sets.empty()) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
  out.cull_blocks(blocks);
  out.splats(records);
  out.end_sheet({static_cast<std::uint32_t>(sheet), static_cast<std::uint32_t>(records.size())});
  report.splat_records += records.size();
  return true;
}

}  // namespace fastsplat::driver
