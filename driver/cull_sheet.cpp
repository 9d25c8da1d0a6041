// A sheet whose splats go in sets (docs/numerics.md, section 8, "Sets"): cells of the screen, their cull_blocks in
// front.
#include <algorithm>
#include <vector>

#include "driver/compiled_state.hpp"

namespace fastsplat::driver {
namespace {

/// A set's record should cost no more than a hundredth of what its splats do where they can be seen.
constexpr std::uint64_t kWindowsOfASet = 100;
/// Sheets of a tile in which nothing can be hidden (docs/numerics.md, section 6.1).
constexpr std::uint64_t kSheetsUnhidden = 2;

}  // namespace

cmodel::CullBlock CompiledFrame::State::set_of(int cell) const {
  const int side = cells.side() - 1 + windows.widest();
  return {.tag = 0, .x = cells.x(cell), .y = cells.y(cell), .width = side, .height = side, .splats = 0};
}

std::vector<int> CompiledFrame::State::set_cells(int tile, int sheet, std::uint64_t written) const {
  std::vector<int> out;
  if (written < kSheetsUnhidden) return out;
  const auto side = static_cast<std::uint64_t>(windows.narrowest() / config.lanes);
  for (int cell = 0; cell < cells.count(); ++cell) {
    std::uint64_t splats = 0;
    for (int from = std::max(0, sheet - reach); from <= sheet; ++from) splats += bins.cell(tile, from, cell).size();
    if (splats * side * side >= kWindowsOfASet) out.push_back(cell);
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
  const std::vector<int> in_sets = set_cells(tile, sheet, report.sheets);
  std::vector<cmodel::CullBlock> sets;
  if (!in_sets.empty()) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
  for (const int cell : in_sets) {
    cmodel::CullBlock set = set_of(cell);
    set.tag = tag;
    const std::size_t before = records.size();
    if (!out.would_hide(set)) gather(cell);
    set.splats = static_cast<std::uint32_t>(records.size() - before);
    sets.push_back(set);
  }
  for (int cell = 0, at = 0; cell < cells.count(); ++cell) {
    if (at < static_cast<int>(in_sets.size()) && in_sets[static_cast<std::size_t>(at)] == cell)
      ++at;
    else
      gather(cell);
  }
  if (in_sets.empty() && records.empty()) return false;
  if (in_sets.empty()) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
  out.cull_blocks(sets);
  out.splats(records);
  out.end_sheet({static_cast<std::uint32_t>(sheet), static_cast<std::uint32_t>(records.size())});
  report.splat_records += records.size();
  return true;
}

}  // namespace fastsplat::driver
