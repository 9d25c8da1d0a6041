#include <algorithm>
#include <vector>

#include "driver/compiled_state.hpp"

namespace fastsplat::driver {
namespace {

/// A splat of a band, ready for its next sheet.
struct Ready {
  cmodel::fast::Placed placed;
  SplatWords words{}, before{};  ///< whole; of it, what lies in front of the next sheet
  std::int32_t depth = 0;
  std::int32_t last_sheet = 0;  ///< beyond it, its shares are empty
};

/// One band drawn, sheet by sheet. Of its splats, those that still can be seen wait in a list; of one that cannot, all
/// sheets are counted at once.
template <class Word>
class BandWalk {
 public:
  using Unit = cmodel::fast::TileUnit<Word>;
  BandWalk(const CompiledFrame::State& s, int tile, int band, Unit& unit)
      : s_(s), tile_(tile), band_(band), place_(s.begin_band(tile, band)), unit_(unit) {
    unit_.begin_band(place_, band == 0, s.reach);
    report_.sheets.resize(static_cast<std::size_t>(s.plan.slabs.count));
  }

  BandReport operator()() {
    std::uint32_t sheets = 0;
    for (int sheet = 0; sheet < s_.plan.slabs.count && unit_.sound(); ++sheet) {
      unit_.begin_sheet({static_cast<std::uint32_t>(sheet)});
      for (std::size_t i = 0; i < waiting_.size();) {
        if (draw(waiting_[i], sheet)) {
          ++i;
          continue;
        }
        // Their order means nothing: sums do not depend on it.
        waiting_[i] = waiting_.back();
        waiting_.pop_back();
      }
      const auto numbers = s_.bins.bin(tile_, band_, sheet);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        __builtin_prefetch(&s_.projected.splats[numbers[std::min(i + kAhead, numbers.size() - 1)]]);
        Ready splat = ready(s_.projected.splats[numbers[i]]);
        if (draw(splat, sheet)) waiting_.push_back(splat);
      }
      if (report_.sheets[static_cast<std::size_t>(sheet)] == 0) continue;
      unit_.end_sheet({static_cast<std::uint32_t>(sheet), 0});
      ++sheets;
    }
    unit_.end_tile({static_cast<std::uint32_t>(tile_), sheets});
    return std::move(report_);
  }

 private:
  Ready ready(const QuantisedSplat& splat) const {
    cmodel::SnappedAxis x = s_.windows.snapped(splat.x, splat.set), y = s_.windows.snapped(splat.y, splat.set);
    x.origin -= place_.x;
    y.origin -= place_.y;
    return {.placed = unit_.place(splat.set, x, y),
            .words = splat.words,
            .before = {},
            .depth = splat.depth,
            .last_sheet = s_.sliced() ? s_.slices.last(splat.depth) : splat.depth};
  }
  Share next_share(Ready& splat, int sheet) const {
    return s_.sliced() ? s_.slices.next_share(splat.words, splat.depth, sheet, splat.before)
                       : s_.slices.whole(splat.words);
  }
  void record(const Ready& splat, std::uint64_t records, std::uint64_t saturated) {
    if (!splat.placed.counted) return;
    report_.splat_records += records;
    report_.saturated_records += saturated;
  }
  /// The splat's part of a sheet; true if there is more to come.
  bool draw(Ready& splat, int sheet) {
    if (unit_.hidden(splat.placed) && hide(splat, sheet)) return false;
    const Share share = next_share(splat, sheet);
    if (!share.empty()) {
      record(splat, 1, share.saturated ? 1 : 0);
      report_.sheets[static_cast<std::size_t>(sheet)] = 1;
      unit_.add(splat.placed, share.words);
    }
    return splat.last_sheet > sheet;
  }
  /// Its parts of this and all later sheets; false, and nothing is done, if the unit cannot have them at once.
  bool hide(const Ready& splat, int sheet) {
    const auto count = static_cast<std::size_t>(splat.last_sheet - sheet + 1);
    if (hidden_.size() < count) hidden_.resize(count);
    cmodel::fast::HiddenShare* out = hidden_.data();
    std::uint64_t saturated = 0;
    std::uint32_t excess = 0;
    const auto take = [&](const Slices::Outline& share) {
      *out++ = {share.largest, share.excess};
      excess |= share.excess;
      saturated += share.saturated ? 1 : 0;
    };
    if (s_.sliced())
      s_.slices.outlines(splat.words, splat.depth, sheet, splat.last_sheet, take);
    else
      take(Slices::outline(s_.slices.whole(splat.words)));
    const auto shares = std::span(hidden_).first(count);
    if (excess != 0 && !unit_.can_hide(splat.placed, shares)) return false;
    const std::uint64_t records = unit_.hide(splat.placed, shares);
    for (std::size_t i = 0; i < count; ++i) report_.sheets[static_cast<std::size_t>(sheet) + i] |= shares[i].word != 0;
    record(splat, records, saturated);
    return true;
  }

  static constexpr std::size_t kAhead = 8;  ///< splats, asked for while others are drawn

  const CompiledFrame::State& s_;
  int tile_, band_;
  cmodel::BeginTile place_;
  Unit& unit_;
  BandReport report_;
  std::vector<Ready> waiting_;
  std::vector<cmodel::fast::HiddenShare> hidden_;  ///< of one splat
};

}  // namespace

template <class Word>
BandReport CompiledFrame::draw_band(int tile, int band, cmodel::fast::TileUnit<Word>& unit) const {
  return BandWalk<Word>(*state_, tile, band, unit)();
}

template BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint16_t>&) const;
template BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint32_t>&) const;

}  // namespace fastsplat::driver
