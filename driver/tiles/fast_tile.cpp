// SPDX-License-Identifier: Apache-2.0
// Provides the splats of a compiled frame to the fast unit's walk (cmodel/fast/band_walk.hpp).
#include "cmodel/fast/band_walk.hpp"
#include "driver/tiles/compiled_state.hpp"

namespace fastsplat::driver {
namespace {

template <class Word>
class BandSplats {
 public:
  using Unit = cmodel::fast::TileUnit<Word>;
  /// State from which a splat's shares are computed.
  struct Rest {
    SplatWords words{}, before{};  ///< the whole splat; its part in front of the next sheet
    std::int32_t depth = 0;
    std::uint32_t number = 0;
    bool grown = false;  ///< CompiledFrame::State::grown()
  };
  using ActiveSplat = cmodel::fast::ActiveSplat<Rest>;

  BandSplats(const CompiledFrame::State& s, int tile, int band)
      : s_(s), tile_(tile), band_number_(band), band_(s.begin_band(tile, band)) {}

  const cmodel::BeginTile& band() const { return band_; }
  int sheets() const { return s_.plan.slabs.count; }
  int reach() const { return s_.reach; }
  int cells() const { return s_.cells.count(); }
  std::span<const std::uint32_t> numbers(int sheet) const { return s_.bins.bin(tile_, band_number_, sheet); }
  std::span<const std::uint32_t> numbers(int sheet, int cell) const { return s_.bins.cell(tile_, sheet, cell); }
  SheetSets sheet_sets(int sheet, std::uint32_t written) const { return s_.sheet_sets(tile_, sheet, written); }
  void prefetch(std::uint32_t number) const { __builtin_prefetch(&s_.projected.splats[number]); }

  template <class Visit>
  void for_each_place(Unit& unit, std::uint32_t number, bool keep, Visit visit) const {
    const QuantisedSplat& splat = s_.projected.splats[number];
    if (splat.set != kOwnShape) {
      cmodel::SnappedAxis x = s_.windows.snapped(splat.x, splat.set), y = s_.windows.snapped(splat.y, splat.set);
      x.origin -= band_.x;
      y.origin -= band_.y;
      visit(ready(number, unit.place(splat.set, x, y)));
      return;
    }
    const int rows = s_.grid.y(tile_) - band_.y, pf = s_.config.position_frac_bits;
    s_.for_each_ellipse(tile_, number, {}, [&](cmodel::EllipseRecord record) {
      record.y += rows * (1 << pf);
      const int top = (record.y >> pf) + record.windows.top;
      const int halo = s_.halo();
      if (top >= band_.height + halo || top + static_cast<int>(record.windows.rows) * s_.config.lanes <= -halo) return;
      std::unique_ptr<std::uint16_t[]> weights;
      ActiveSplat one = ready(number, unit.place(record, keep ? &weights : nullptr));
      one.weights = std::move(weights);
      visit(std::move(one));
    });
  }
  /// The splat's share in a sheet; called for consecutive sheets.
  Share next_share(Rest& splat, int sheet) const {
    if (!s_.sliced()) return s_.slices.whole(splat.words);
    if (splat.grown) return s_.share(splat.number, sheet);
    return s_.slices.next_share(splat.words, splat.depth, sheet, splat.before);
  }
  Share share(std::uint32_t number, int sheet) const { return s_.share(number, sheet); }
  template <class Visit>
  void for_each_outline(const Rest& splat, int sheet, int last_sheet, Visit visit) const {
    if (splat.grown) {
      for (int at = sheet; at <= last_sheet; ++at) visit(Slices::outline(s_.share(splat.number, at)));
    } else if (s_.sliced()) {
      s_.slices.outlines(splat.words, splat.depth, sheet, last_sheet, visit);
    } else {
      visit(Slices::outline(s_.slices.whole(splat.words)));
    }
  }

 private:
  ActiveSplat ready(std::uint32_t number, const cmodel::fast::PlacedFootprint& placed) const {
    const QuantisedSplat& splat = s_.projected.splats[number];
    const bool grown = s_.grown(number);
    const int last = !s_.sliced() ? splat.depth
                     : grown      ? s_.slices.last(splat.depth, s_.growth(number))
                                  : s_.slices.last(splat.depth);
    return {.placed = placed,
            .weights = nullptr,
            .last_sheet = last,
            .rest = {.words = splat.words, .before = {}, .depth = splat.depth, .number = number, .grown = grown}};
  }

  const CompiledFrame::State& s_;
  int tile_, band_number_;
  cmodel::BeginTile band_;
};

}  // namespace

template <class Word>
cmodel::fast::BandReport CompiledFrame::draw_band(int tile, int band, cmodel::fast::TileUnit<Word>& unit) const {
  const BandSplats<Word> splats(*state_, tile, band);
  if (state_->in_sets()) return cmodel::fast::CullWalk(splats, unit)();
  return cmodel::fast::BandWalk(splats, band == 0, unit)();
}

template cmodel::fast::BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint16_t>&) const;
template cmodel::fast::BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint32_t>&) const;

}  // namespace fastsplat::driver
