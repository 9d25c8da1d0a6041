// SPDX-License-Identifier: Apache-2.0
// Draws a tile with the fast unit, sheet by sheet, from splats instead of records. A splat is placed once for all of
// its sheets, and records are never stored.
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

/// A band's part of its tile's report.
struct BandReport {
  std::uint64_t splat_records = 0, saturated_records = 0;
  std::vector<std::uint8_t> sheets;  ///< for each sheet of the frame: 1 with a record, else 0
};

// The interface that a walk requires of Splats, the splats of one band by number:
// - band(): its BeginTile
// - sheets(), reach(): sheets of the frame; a splat has records in at most reach() sheets after its first
// - numbers(sheet): the splats whose first sheet this is, a span
// - prefetch(number): announces that the splat begins soon
// - for_each_place(unit, number, keep, visit): calls visit(ActiveSplat) for each record of the splat in a sheet, placed
// by
//   the unit; with `keep`, ActiveSplat::weights holds an ellipse's weights
// - next_share(splat, sheet): {words, saturated, empty()} of its records in this sheet; sheets come in order
// - for_each_outline(splat, sheet, last, visit): calls visit({largest, excess, saturated}) for its share of each of
//   these sheets
//
// Splats for a device that culls also have cells(), sheet_sets(sheet, written), numbers(sheet, cell) and
// share(number, sheet).

/// An active splat of a band, or one record of its ellipse, before its next sheet. `Rest` is the state that Splats
/// keeps.
template <class Rest>
struct ActiveSplat {
  PlacedFootprint placed;
  std::unique_ptr<std::uint16_t[]> weights;  ///< of an ellipse
  std::int32_t last_sheet = 0;               ///< after it all shares are empty
  Rest rest;
};

/// Draws a band, sheet by sheet. Visible splats wait in a list; a hidden one's sheets are all counted at once.
template <class Word, class Splats>
class BandWalk {
 public:
  using Splat = ActiveSplat<typename Splats::Rest>;
  /// `splats` and `unit` must outlive it. `first`: this is the tile's first band.
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
        // Any order will do: sums do not depend on it.
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
  /// Retires a splat. Its weights are kept until the sheet ends, because they may not be drawn yet.
  void done(Splat& splat) {
    if (splat.weights) done_.push_back(std::move(splat.weights));
  }
  /// Begins a splat in its first sheet. If it is drawn once, its weights need not be kept.
  void begin(std::uint32_t number, int sheet) {
    splats_.for_each_place(unit_, number, splats_.reach() > 0, [&](Splat splat) {
      if (draw(splat, sheet))
        waiting_.push_back(std::move(splat));
      else
        done(splat);
    });
  }
  /// Draws the splat's share of a sheet; true if more are to come.
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
  /// Hides the splat's shares of this and all later sheets. Returns false, with nothing done, if the unit cannot.
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

  static constexpr std::size_t kAhead = 8;  ///< splats prefetched while others are drawn

  const Splats& splats_;
  TileUnit<Word>& unit_;
  BandReport report_;
  std::vector<Splat> waiting_;
  std::vector<std::unique_ptr<std::uint16_t[]>> done_;  ///< weights in use by the open sheet
  std::vector<HiddenShare> hidden_;                     ///< shares of one splat
};

/// Draws a tile like a device that culls, sheet by sheet and cull cell by cull cell. Splats of a hidden cull group are
/// not visited again. In its cells, later ones that are too few for a group are counted one by one.
template <class Word, class Splats>
class CullWalk {
 public:
  using Splat = ActiveSplat<typename Splats::Rest>;
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
    std::vector<Splat> waiting;  ///< in any order
    bool hidden = false;         ///< for the rest of the tile
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
  /// Draws the splat's share of a sheet; true if more are to come.
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
  /// Counts the records of a hidden cell that are in no cull group: each is hidden by itself.
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

  static constexpr std::size_t kAhead = 8;  ///< splats prefetched while others are drawn

  const Splats& splats_;
  TileUnit<Word>& unit_;
  BandReport report_;
  std::vector<Cell> cells_;
};

}  // namespace fastsplat::cmodel::fast
