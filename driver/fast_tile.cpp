#include <algorithm>
#include <vector>

#include "driver/compiled_state.hpp"

namespace fastsplat::driver {
namespace {

/// A splat of a band, ready for any of its sheets.
struct Ready {
  cmodel::fast::Placed placed;
  SplatWords words{}, before{};  ///< whole; of it, what lies in front of the next sheet
  std::int32_t depth = 0;
  std::int32_t last_sheet = 0;  ///< beyond it, its shares are empty
};

/// The splats of a band that reach the sheet at hand, those that begin in it added.
template <class Word>
void add_ready(const CompiledFrame::State& s, int tile, int band, int sheet, const cmodel::fast::TileUnit<Word>& unit,
               std::vector<Ready>& splats) {
  const cmodel::BeginTile place = s.begin_band(tile, band);
  for (const std::uint32_t number : s.bins.bin(tile, band, sheet)) {
    const QuantisedSplat& splat = s.projected.splats[number];
    cmodel::SnappedAxis x = s.windows.snapped(splat.x, splat.set), y = s.windows.snapped(splat.y, splat.set);
    x.origin -= place.x;
    y.origin -= place.y;
    splats.push_back({.placed = unit.place(splat.set, x, y),
                      .words = splat.words,
                      .before = {},
                      .depth = splat.depth,
                      .last_sheet = s.sliced() ? s.slices.last(splat.depth) : splat.depth});
  }
}

}  // namespace

template <class Word>
BandReport CompiledFrame::draw_band(int tile, int band, cmodel::fast::TileUnit<Word>& unit) const {
  const State& s = *state_;
  BandReport report{.sheets = std::vector<bool>(static_cast<std::size_t>(s.plan.slabs.count))};
  unit.begin_band(s.begin_band(tile, band), band == 0);
  std::vector<Ready> splats;
  for (int sheet = 0; sheet < s.plan.slabs.count; ++sheet) {
    add_ready(s, tile, band, sheet, unit, splats);
    std::uint32_t records = 0;
    for (std::size_t i = 0; i < splats.size();) {
      Ready& splat = splats[i];
      const Share share =
          s.sliced() ? s.slices.next_share(splat.words, splat.depth, sheet, splat.before) : s.slices.whole(splat.words);
      if (!share.empty()) {
        if (splat.placed.counted) {
          ++report.splat_records;
          report.saturated_records += share.saturated ? 1 : 0;
        }
        unit.add(splat.placed, share.words);
        ++records;
      }
      // Their order means nothing: sums do not depend on it.
      if (splat.last_sheet > sheet) {
        ++i;
      } else {
        splat = splats.back();
        splats.pop_back();
      }
    }
    if (records == 0) continue;
    unit.end_sheet({static_cast<std::uint32_t>(sheet), records});
    report.sheets[static_cast<std::size_t>(sheet)] = true;
  }
  unit.end_tile(
      {static_cast<std::uint32_t>(tile), static_cast<std::uint32_t>(std::ranges::count(report.sheets, true))});
  return report;
}

template BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint16_t>&) const;
template BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint32_t>&) const;

}  // namespace fastsplat::driver
