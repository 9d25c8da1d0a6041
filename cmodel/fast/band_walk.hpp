// How the fast unit draws a tile: sheet by sheet, from splats and not from records. A splat is placed once for all of
// its sheets, and no record is ever in memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cmodel/fast/tile_unit.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel::fast {

/// What one band's splats add to its tile's.
struct BandReport {
  std::uint64_t splat_records = 0, saturated_records = 0;
  std::vector<std::uint8_t> sheets;  ///< of all the frame's: 1 with a record, else 0
};

// The interface of Splats, the splats of one band by number, that a walk requires:
// - band(): its BeginTile
// - sheets(), reach(): sheets of the frame; a splat has records in at most reach() sheets after its first
// - numbers(sheet): the splats whose first sheet this is, a span
// - prefetch(number): announces that the splat begins soon
// - for_each_place(unit, number, keep, visit): calls visit(Ready) for each record that a sheet has of the splat, placed
//   by the unit; with `keep`, an ellipse's weights are in Ready::weights
// - next_share(splat, sheet): {words, saturated, empty()} of its records in this sheet; sheets come in order
// - for_each_outline(splat, sheet, last, visit): calls visit({largest, excess, saturated}) for its shares of these
//   sheets
//
// Splats of a device that culls also have cells(), sheet_sets(sheet, written), numbers(sheet, cell) and
// share(number, sheet).

/// A splat of a band, or one record of its ellipse, ready for its next sheet. `Rest` is what Splats keeps of it.
template <class Rest>
struct Ready {
  Placed placed;
  std::unique_ptr<std::uint16_t[]> weights;  ///< an ellipse's own
  std::int32_t last_sheet = 0;               ///< beyond it, its shares are empty
  Rest rest;
};

/// Draws a band, sheet by sheet. Splats that can still be seen wait in a list; of a hidden one, all sheets are counted
/// at once.
template <class Word, class Splats>
class BandWalk {
 public:
  using Splat = Ready<typename Splats::Rest>;
  /// Both outlive it. `first`: of the tile's bands.
  BandWalk(const Splats& splats, bool first, TileUnit<Word>& unit) : splats_(splats), unit_(unit) {
    unit_.begin_band(splats.band(), first, splats.reach());
    report_.sheets.resize(static_cast<std::size_t>(splats.sheets()));
  }

  BandReport operator()() {
    std::uint32_t sheets = 0;
    for (int sheet = 0; sheet < splats_.sheets() && unit_.sound(); ++sheet) {
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
      const std::span<const std::uint32_t> numbers = splats_.numbers(sheet);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        splats_.prefetch(numbers[std::min(i + kAhead, numbers.size() - 1)]);
        begin(numbers[i], sheet);
      }
      if (report_.sheets[static_cast<std::size_t>(sheet)] == 0) continue;
      unit_.end_sheet({static_cast<std::uint32_t>(sheet), 0});
      done_.clear();
      ++sheets;
    }
    unit_.end_tile({splats_.band().tile, sheets});
    return std::move(report_);
  }

 private:
  void record(const Splat& splat, std::uint64_t records, std::uint64_t saturated) {
    if (!splat.placed.counted) return;
    report_.splat_records += records;
    report_.saturated_records += saturated;
  }
  /// It has no more to come; its weights may have.
  void done(Splat& splat) {
    if (splat.weights) done_.push_back(std::move(splat.weights));
  }
  /// A splat in its first sheet. Where it is drawn once, its weights need not be kept.
  void begin(std::uint32_t number, int sheet) {
    splats_.for_each_place(unit_, number, splats_.reach() > 0, [&](Splat splat) {
      if (draw(splat, sheet))
        waiting_.push_back(std::move(splat));
      else
        done(splat);
    });
  }
  /// The splat's part of a sheet; true if there is more to come.
  bool draw(Splat& splat, int sheet) {
    if (unit_.hidden(splat.placed) && hide(splat, sheet)) return false;
    const auto share = splats_.next_share(splat.rest, sheet);
    if (!share.empty()) {
      record(splat, 1, share.saturated ? 1 : 0);
      report_.sheets[static_cast<std::size_t>(sheet)] = 1;
      unit_.add(splat.placed, share.words);
    }
    return splat.last_sheet > sheet;
  }
  /// Its parts of this and all later sheets; false, and nothing is done, if the unit cannot have them at once.
  bool hide(const Splat& splat, int sheet) {
    const auto count = static_cast<std::size_t>(splat.last_sheet - sheet + 1);
    if (hidden_.size() < count) hidden_.resize(count);
    HiddenShare* out = hidden_.data();
    std::uint64_t saturated = 0;
    std::uint32_t excess = 0;
    splats_.for_each_outline(splat.rest, sheet, splat.last_sheet, [&](const auto& share) {
      *out++ = {share.largest, share.excess};
      excess |= share.excess;
      saturated += share.saturated ? 1 : 0;
    });
    const auto shares = std::span(hidden_).first(count);
    if (excess != 0 && !unit_.can_hide(splat.placed, shares)) return false;
    const std::uint64_t records = unit_.hide(splat.placed, shares);
    for (std::size_t i = 0; i < count; ++i) report_.sheets[static_cast<std::size_t>(sheet) + i] |= shares[i].word != 0;
    record(splat, records, saturated);
    return true;
  }

  static constexpr std::size_t kAhead = 8;  ///< splats, asked for while others are drawn

  const Splats& splats_;
  TileUnit<Word>& unit_;
  BandReport report_;
  std::vector<Splat> waiting_;
  std::vector<std::unique_ptr<std::uint16_t[]>> done_;  ///< weights of the open sheet
  std::vector<HiddenShare> hidden_;                     ///< of one splat
};

/// Draws a tile as a device that culls does, sheet by sheet and cell by cell. Once a set is hidden, its splats are not
/// looked at again, unless they are too few for a set: then they are counted one by one.
template <class Word, class Splats>
class CullWalk {
 public:
  using Splat = Ready<typename Splats::Rest>;
  CullWalk(const Splats& splats, TileUnit<Word>& unit)
      : splats_(splats), unit_(unit), cells_(static_cast<std::size_t>(splats.cells())) {
    unit_.begin_band(splats.band(), true, 0);
    report_.sheets.resize(static_cast<std::size_t>(splats.sheets()));
  }

  BandReport operator()() {
    std::uint32_t written = 0;
    for (int sheet = 0; sheet < splats_.sheets() && unit_.sound(); ++sheet) {
      const auto split = splats_.sheet_sets(sheet, written);
      const std::uint64_t before = report_.splat_records;
      for (const auto& set : split.sets) {
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
    unit_.end_tile({splats_.band().tile, written});
    return std::move(report_);
  }

 private:
  struct Cell {
    std::vector<Splat> waiting;  ///< in no order that means anything
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
    const std::span<const std::uint32_t> numbers = splats_.numbers(sheet, number);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      splats_.prefetch(numbers[std::min(i + kAhead, numbers.size() - 1)]);
      splats_.for_each_place(unit_, numbers[i], false, [&](Splat splat) {
        if (draw(splat, sheet)) cell.waiting.push_back(std::move(splat));
      });
    }
  }
  /// The splat's part of a sheet; true if there is more to come.
  bool draw(Splat& splat, int sheet) {
    const auto share = splats_.next_share(splat.rest, sheet);
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
    for (int from = std::max(0, sheet - splats_.reach()); from <= sheet; ++from) {
      for (const std::uint32_t splat : splats_.numbers(from, number)) {
        const auto share = splats_.share(splat, sheet);
        if (share.empty()) continue;
        ++report_.splat_records;
        report_.saturated_records += share.saturated ? 1 : 0;
        unit_.count_culled(1);
      }
    }
  }

  static constexpr std::size_t kAhead = 8;  ///< splats, asked for while others are drawn

  const Splats& splats_;
  TileUnit<Word>& unit_;
  BandReport report_;
  std::vector<Cell> cells_;
};

}  // namespace fastsplat::cmodel::fast
