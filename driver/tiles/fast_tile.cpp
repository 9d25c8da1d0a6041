#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "driver/tiles/compiled_state.hpp"

namespace fastsplat::driver {
namespace {

/// A splat of a band, or one record of its ellipse, ready for its next sheet.
struct Ready {
  cmodel::fast::Placed placed;
  std::unique_ptr<std::uint16_t[]> weights;  ///< an ellipse's own
  SplatWords words{}, before{};              ///< whole; of it, what lies in front of the next sheet
  std::int32_t depth = 0;
  std::int32_t last_sheet = 0;  ///< beyond it, its shares are empty
  std::uint32_t number = 0;
  bool grown = false;  ///< CompiledFrame::State::grown()
};

Ready ready(const CompiledFrame::State& s, std::uint32_t number, const cmodel::fast::Placed& placed) {
  const QuantisedSplat& splat = s.projected.splats[number];
  const bool grown = s.grown(number);
  const int last = !s.sliced() ? splat.depth
                   : grown     ? s.slices.last(splat.depth, s.growth(number))
                               : s.slices.last(splat.depth);
  return {.placed = placed,
          .weights = nullptr,
          .words = splat.words,
          .before = {},
          .depth = splat.depth,
          .last_sheet = last,
          .number = number,
          .grown = grown};
}

template <class Unit>
Ready ready_circle(const CompiledFrame::State& s, const cmodel::BeginTile& place, Unit& unit, std::uint32_t number) {
  const QuantisedSplat& splat = s.projected.splats[number];
  cmodel::SnappedAxis x = s.windows.snapped(splat.x, splat.set), y = s.windows.snapped(splat.y, splat.set);
  x.origin -= place.x;
  y.origin -= place.y;
  return ready(s, number, unit.place(splat.set, x, y));
}

/// The splat's part of a sheet: sheet after sheet.
Share next_share(const CompiledFrame::State& s, Ready& splat, int sheet) {
  if (!s.sliced()) return s.slices.whole(splat.words);
  if (splat.grown) return s.share(splat.number, sheet);
  return s.slices.next_share(splat.words, splat.depth, sheet, splat.before);
}

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
        done(waiting_[i]);
        waiting_[i] = std::move(waiting_.back());
        waiting_.pop_back();
      }
      const auto numbers = s_.bins.bin(tile_, band_, sheet);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        __builtin_prefetch(&s_.projected.splats[numbers[std::min(i + kAhead, numbers.size() - 1)]]);
        begin(numbers[i], sheet);
      }
      if (report_.sheets[static_cast<std::size_t>(sheet)] == 0) continue;
      unit_.end_sheet({static_cast<std::uint32_t>(sheet), 0});
      done_.clear();
      ++sheets;
    }
    unit_.end_tile({static_cast<std::uint32_t>(tile_), sheets});
    return std::move(report_);
  }

 private:
  void record(const Ready& splat, std::uint64_t records, std::uint64_t saturated) {
    if (!splat.placed.counted) return;
    report_.splat_records += records;
    report_.saturated_records += saturated;
  }
  /// It has no more to come; its weights may have.
  void done(Ready& splat) {
    if (splat.weights) done_.push_back(std::move(splat.weights));
  }
  /// A splat in its first sheet.
  void begin(std::uint32_t number, int sheet) {
    const auto draw_ready = [&](Ready splat) {
      if (draw(splat, sheet))
        waiting_.push_back(std::move(splat));
      else
        done(splat);
    };
    if (s_.projected.splats[number].set != kOwnShape) {
      draw_ready(ready_circle(s_, place_, unit_, number));
      return;
    }
    const int rows = s_.grid.y(tile_) - place_.y, pf = s_.config.position_frac_bits;
    s_.for_each_ellipse(tile_, number, {}, [&](cmodel::EllipseRecord record) {
      record.y += rows * (1 << pf);
      const int top = (record.y >> pf) + record.windows.top;
      const int rim = s_.rim();
      if (top >= place_.height + rim || top + static_cast<int>(record.windows.rows) * s_.config.lanes <= -rim) return;
      // Where it is drawn once, its weights need not be kept.
      std::unique_ptr<std::uint16_t[]> weights;
      Ready splat = ready(s_, number, unit_.place(record, s_.reach > 0 ? &weights : nullptr));
      splat.weights = std::move(weights);
      draw_ready(std::move(splat));
    });
  }
  /// The splat's part of a sheet; true if there is more to come.
  bool draw(Ready& splat, int sheet) {
    if (unit_.hidden(splat.placed) && hide(splat, sheet)) return false;
    const Share share = next_share(s_, splat, sheet);
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
    if (splat.grown) {
      for (int at = sheet; at <= splat.last_sheet; ++at) take(Slices::outline(s_.share(splat.number, at)));
    } else if (s_.sliced()) {
      s_.slices.outlines(splat.words, splat.depth, sheet, splat.last_sheet, take);
    } else {
      take(Slices::outline(s_.slices.whole(splat.words)));
    }
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
  std::vector<std::unique_ptr<std::uint16_t[]>> done_;  ///< weights of the open sheet
  std::vector<cmodel::fast::HiddenShare> hidden_;       ///< of one splat
};

/// One tile drawn on a device that culls, sheet by sheet and cell by cell: the splats of a set that was hidden once are
/// never looked at again, but where they are so few that they are no set.
template <class Word>
class CullWalk {
 public:
  using Unit = cmodel::fast::TileUnit<Word>;
  CullWalk(const CompiledFrame::State& s, int tile, Unit& unit)
      : s_(s),
        tile_(tile),
        place_(s.begin_band(tile, 0)),
        unit_(unit),
        cells_(static_cast<std::size_t>(s.cells.count())) {
    unit_.begin_band(place_, true, 0);
    report_.sheets.resize(static_cast<std::size_t>(s.plan.slabs.count));
  }

  BandReport operator()() {
    std::uint32_t written = 0;
    for (int sheet = 0; sheet < s_.plan.slabs.count && unit_.sound(); ++sheet) {
      const SheetSets split = s_.sheet_sets(tile_, sheet, written);
      const std::uint64_t before = report_.splat_records;
      for (const CellSet& set : split.sets) {
        unit_.cull_blocks({&set.block, 1});
        const bool hidden = unit_.would_hide(set.block);
        for (const int cell : set.cells) {
          if (hidden)
            hide(cells_[static_cast<std::size_t>(cell)]);
          else
            draw(cell, sheet);
        }
      }
      for (const int cell : split.others) draw(cell, sheet);
      if (split.sets.empty() && report_.splat_records == before) continue;
      report_.sheets[static_cast<std::size_t>(sheet)] = 1;
      unit_.end_sheet({static_cast<std::uint32_t>(sheet), 0});
      ++written;
    }
    unit_.end_tile({static_cast<std::uint32_t>(tile_), written});
    return std::move(report_);
  }

 private:
  struct Cell {
    std::vector<Ready> waiting;  ///< in no order that means anything
    bool hidden = false;         ///< all of it, for good
  };

  static void hide(Cell& cell) {
    cell.hidden = true;
    cell.waiting.clear();
  }
  void draw(int number, int sheet) {
    Cell& cell = cells_[static_cast<std::size_t>(number)];
    if (cell.hidden) {
      count(number, sheet);
      return;
    }
    for (std::size_t i = 0; i < cell.waiting.size();) {
      if (draw(cell.waiting[i], sheet)) {
        ++i;
        continue;
      }
      cell.waiting[i] = std::move(cell.waiting.back());
      cell.waiting.pop_back();
    }
    const auto numbers = s_.bins.cell(tile_, sheet, number);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      __builtin_prefetch(&s_.projected.splats[numbers[std::min(i + kAhead, numbers.size() - 1)]]);
      Ready splat = ready_circle(s_, place_, unit_, numbers[i]);
      if (draw(splat, sheet)) cell.waiting.push_back(std::move(splat));
    }
  }
  /// The splat's part of a sheet; true if there is more to come.
  bool draw(Ready& splat, int sheet) {
    const Share share = next_share(s_, splat, sheet);
    if (!share.empty()) {
      ++report_.splat_records;
      report_.saturated_records += share.saturated ? 1 : 0;
      if (unit_.culled(splat.placed))
        unit_.count_culled(1);
      else
        unit_.add(splat.placed, share.words);
    }
    return splat.last_sheet > sheet;
  }
  /// Records of a hidden cell that go in no set: each is hidden by itself.
  void count(int number, int sheet) {
    for (int from = std::max(0, sheet - s_.reach); from <= sheet; ++from) {
      for (const std::uint32_t splat : s_.bins.cell(tile_, from, number)) {
        const Share share = s_.share(splat, sheet);
        if (share.empty()) continue;
        ++report_.splat_records;
        report_.saturated_records += share.saturated ? 1 : 0;
        unit_.count_culled(1);
      }
    }
  }

  static constexpr std::size_t kAhead = 8;  ///< splats, asked for while others are drawn

  const CompiledFrame::State& s_;
  int tile_;
  cmodel::BeginTile place_;
  Unit& unit_;
  BandReport report_;
  std::vector<Cell> cells_;
};

}  // namespace

template <class Word>
BandReport CompiledFrame::draw_band(int tile, int band, cmodel::fast::TileUnit<Word>& unit) const {
  if (state_->in_sets()) return CullWalk<Word>(*state_, tile, unit)();
  return BandWalk<Word>(*state_, tile, band, unit)();
}

template BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint16_t>&) const;
template BandReport CompiledFrame::draw_band(int, int, cmodel::fast::TileUnit<std::uint32_t>&) const;

}  // namespace fastsplat::driver
