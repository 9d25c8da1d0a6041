#include <vector>

#include "driver/compiled_state.hpp"

namespace fastsplat::driver {
namespace {

/// A splat of a tile, ready for any of its sheets.
struct Ready {
  cmodel::fast::Placed placed;
  SplatWords words{}, before{};  ///< whole; of it, what lies in front of the next sheet
  std::int32_t depth = 0;
  std::int32_t last_sheet = 0;  ///< beyond it, its shares are empty
};

/// In the order of the tile's bins.
template <class Word>
std::vector<Ready> ready_splats(const CompiledFrame::State& s, int tile, const cmodel::fast::TileUnit<Word>& unit) {
  std::vector<Ready> out;
  const auto numbers = s.bins.tile(tile);
  out.reserve(numbers.size());
  for (const std::uint32_t number : numbers) {
    const QuantisedSplat& splat = s.projected.splats[number];
    cmodel::SnappedAxis x = s.windows.snapped(splat.x, splat.set), y = s.windows.snapped(splat.y, splat.set);
    x.origin -= s.grid.x(tile);
    y.origin -= s.grid.y(tile);
    out.push_back({.placed = unit.place(splat.set, x, y),
                   .words = splat.words,
                   .before = {},
                   .depth = splat.depth,
                   .last_sheet = s.sliced() ? s.slices.last(splat.depth) : splat.depth});
  }
  return out;
}

}  // namespace

template <class Word>
TileReport CompiledFrame::draw_tile(int tile, cmodel::fast::TileUnit<Word>& unit) const {
  const State& s = *state_;
  TileReport report;
  unit.begin_tile(s.begin_tile(tile));
  std::vector<Ready> splats = ready_splats(s, tile, unit);
  const auto* const first = s.bins.tile(tile).data();
  for (int sheet = 0; sheet < s.plan.slabs.count; ++sheet) {
    std::uint32_t records = 0;
    for (int from = std::max(0, sheet - s.reach); from <= sheet; ++from) {
      const auto bin = s.bins.bin(tile, from);
      for (Ready& splat : std::span(splats).subspan(static_cast<std::size_t>(bin.data() - first), bin.size())) {
        if (splat.last_sheet < sheet) continue;
        const Share share = s.sliced() ? s.slices.next_share(splat.words, splat.depth, sheet, splat.before)
                                       : s.slices.whole(splat.words);
        if (share.empty()) continue;
        report.saturated_records += share.saturated ? 1 : 0;
        unit.add(splat.placed, share.words);
        ++records;
      }
    }
    if (records == 0) continue;
    unit.end_sheet({static_cast<std::uint32_t>(sheet), records});
    ++report.sheets;
    report.splat_records += records;
  }
  unit.end_tile({static_cast<std::uint32_t>(tile), static_cast<std::uint32_t>(report.sheets)});
  return report;
}

template TileReport CompiledFrame::draw_tile(int, cmodel::fast::TileUnit<std::uint16_t>&) const;
template TileReport CompiledFrame::draw_tile(int, cmodel::fast::TileUnit<std::uint32_t>&) const;

}  // namespace fastsplat::driver
