// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_cycles.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "cmodel/cycles/cycle_stages.hpp"

namespace fastsplat::testbench {
namespace {

/// A device that culls has the hazard counter only for the numbering; without every sample it stays 0.
bool can_rise(const cmodel::Config& config, std::string_view counter) {
  return counter != "stall_hazard" || config.composite_every_sample != 0;
}

/// Beyond four cycles a word is read from memory again; bins go up to twice that.
constexpr std::uint64_t kDistances = 8;
/// end_sheet, begin_sheet, window: no word is met sooner across a swap.
constexpr std::uint64_t kLeastSwap = 3;
/// Delay of a window on the splat path by ellipses and interpolation.
std::uint64_t path_delay(const cmodel::Config& config) {
  return cmodel::stages::splat_delay(config) + cmodel::stages::weight_delay(config);
}
/// The most windows that a sheet can issue before the walk of the previous sheet begins. An earlier walk that delays
/// this walk also delays the sheet's own begin_sheet.
std::uint64_t walk_begins(const cmodel::Config& config) { return path_delay(config) + cmodel::stages::kWalk - 2; }
constexpr std::uint64_t kWalkEnds = 16;
constexpr std::uint64_t kSheetSizes = 41;

constexpr std::array kOpcodes{std::pair{cmodel::Opcode::BeginFrame, "begin_frame"},
                              std::pair{cmodel::Opcode::LoadTable, "load_table"},
                              std::pair{cmodel::Opcode::BeginTile, "begin_tile"},
                              std::pair{cmodel::Opcode::BeginSheet, "begin_sheet"},
                              std::pair{cmodel::Opcode::Splat, "splat"},
                              std::pair{cmodel::Opcode::CullBlock, "cull_block"},
                              std::pair{cmodel::Opcode::EndSheet, "end_sheet"},
                              std::pair{cmodel::Opcode::EndTile, "end_tile"},
                              std::pair{cmodel::Opcode::EndFrame, "end_frame"}};

std::size_t kind_of(const cmodel::BeatCycles& beat) {
  if (beat.payload) return kOpcodes.size() - 1;
  const auto opcode = beat.opcode == cmodel::Opcode::Ellipse ? cmodel::Opcode::Splat : beat.opcode;
  for (std::size_t i = 1; i < kOpcodes.size(); ++i) {
    if (kOpcodes[i].first == opcode) return i - 1;
  }
  return 0;
}

/// One bin for 1, one for 2..15, one for more.
Coverage::Id lengths(Coverage& coverage, const std::string& group, const std::string& prefix) {
  const auto first = coverage.declare(group, prefix + "1");
  coverage.declare(group, prefix + "2_to_15");
  coverage.declare(group, prefix + "16_and_more");
  return first;
}
std::size_t length(std::uint64_t cycles) { return cycles == 1 ? 0 : cycles < 16 ? 1 : 2; }

}  // namespace

CycleCoverage::CycleCoverage(const cmodel::Config& config, bool sliced, Coverage& coverage)
    : config_(config),
      sliced_(sliced),
      coverage_(coverage),
      columns_(static_cast<std::size_t>(config.tile_width)),
      written_(columns_ * static_cast<std::size_t>(config.tile_height)) {
  const auto distances = [&](const char* prefix, std::uint64_t from, std::uint64_t to) {
    const Id first = coverage.bins().size();
    for (std::uint64_t d = from; d <= to; ++d) coverage.declare("hazard", prefix + std::to_string(d));
    return first;
  };
  dense_ = distances("distance_", 1, kDistances);
  bubbled_ = distances("with_bubble_", 2, 4);
  swap_distance_ = distances("across_swap_", kLeastSwap, kDistances);
  whole_overlap_ = distances("whole_window_", 1, 4);
  part_overlap_ = distances("part_of_window_", 1, 4);
  windows_in_sheet_ = coverage.declare_range("swap", "sheet_of_windows_", kSheetSizes);
  walk_begins_ = coverage.declare_range("swap", "walk_begins_at_window_", walk_begins(config) + 1);
  walk_begins_after_ = coverage.declare("swap", "walk_begins_after_the_sheet");
  walk_ends_ = coverage.declare_range("swap", "walk_ends_at_window_", kWalkEnds + 1);
  walk_ends_after_ = coverage.declare("swap", "walk_ends_after_the_sheet");
  walk_at_once_ = coverage.declare("swap", "walk_at_once");
  walk_waits_ = coverage.declare("swap", "walk_waits_for_the_one_before");
  empty_walk_ = coverage.declare("swap", "walk_of_nothing");
  compositor_bound_ = coverage.declare("swap", "more_blocks_than_windows_beside");
  buffer_wait_ = lengths(coverage, "wait", "begin_sheet_");
  wait_begin_tile_ = lengths(coverage, "wait", "begin_tile_");
  wait_end_tile_ = lengths(coverage, "wait", "end_tile_");
  // Before begin_frame the source is never late.
  bubble_ = coverage.bins().size();
  for (const auto& [opcode, name] : kOpcodes) {
    if (opcode != cmodel::Opcode::BeginFrame) coverage.declare("bubble", std::string("before_") + name);
  }
  coverage.declare("bubble", "before_table_words");
  bubble_length_ = lengths(coverage, "bubble", "of_cycles_");
  held_ = lengths(coverage, "wait", "source_for_device_");
  first_beat_held_ = coverage.declare("output", "first_beat_held");
  middle_beat_held_ = coverage.declare("output", "middle_beat_held");
  last_beat_held_ = coverage.declare("output", "last_beat_held");
  never_held_ = coverage.declare("output", "tile_never_held");
  every_held_ = coverage.declare("output", "every_beat_held");
  one_beat_ = coverage.declare("output", "tile_of_one_beat");
  hold_length_ = lengths(coverage, "output", "held_");
  stall_ = coverage.bins().size();
  cmodel::StallCounters{}.for_each(config, [&](const char* name, std::uint64_t, const char*) {
    if (can_rise(config, name)) coverage.declare("counter", name);
  });
  if (config.composite_every_sample != 0) samples_.emplace(config, coverage);
}

void CycleCoverage::on_beat(const cmodel::BeatCycles& beat) {
  const bool first = beat.opcode == cmodel::Opcode::BeginFrame;
  if (beat.offered > beat.wanted && !first) {
    coverage_.hit(bubble_ + kind_of(beat));
    coverage_.hit(bubble_length_ + length(beat.offered - beat.wanted));
  }
  if (beat.taken > beat.offered) coverage_.hit(held_ + length(beat.taken - beat.offered));
  if (beat.payload || beat.left == beat.entered) return;
  if (beat.opcode == cmodel::Opcode::BeginTile) coverage_.hit(wait_begin_tile_ + length(beat.left - beat.entered));
  if (beat.opcode == cmodel::Opcode::EndTile) coverage_.hit(wait_end_tile_ + length(beat.left - beat.entered));
}

void CycleCoverage::begin_tile(const cmodel::BeginTile& tile) {
  width_ = tile.width;
  height_ = tile.height;
  every_sample_ = cmodel::every_sample(tile.mode);
  if (every_sample_) samples_->begin_tile(width_, height_);
  walk_known_ = false;
}

void CycleCoverage::on_tap(const cmodel::TapRecord& record) {
  if (record.tap == cmodel::Tap::Sheet) window(record);
  if (record.tap == cmodel::Tap::Composite && every_sample_) samples_->window(record);
  if (record.tap == cmodel::Tap::Pixel) pixel_beat(record.cycle);
}

void CycleCoverage::window(const cmodel::TapRecord& record) {
  const std::uint64_t issued = record.cycle - path_delay(config_) - cmodel::stages::kSheet;
  if (walk_known_) {
    if (issued < before_.walk_from) ++windows_before_walk_;
    if (issued < before_.walk_to) ++windows_before_end_;
  }
  ++window_number_;
  hazards(record);
}

void CycleCoverage::hazards(const cmodel::TapRecord& record) {
  std::uint64_t nearest = kDistances + 1, nearest_swap = kDistances + 1;
  std::uint64_t met = 0, inside = 0;
  bool dense = false;
  for (int y = std::max(0, record.y); y < std::min(height_, record.y + config_.lanes); ++y) {
    for (int x = std::max(0, record.x); x < std::min(width_, record.x + config_.lanes); ++x) {
      Written& word = written_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
      const std::uint64_t distance = record.cycle - word.cycle;
      ++inside;
      if (word.sheet == sheet_number_ && distance <= nearest) {
        met = distance == nearest ? met + 1 : 1;
        nearest = distance;
        dense = window_number_ - word.window == distance;
      } else if (word.sheet + 1 == sheet_number_) {
        nearest_swap = std::min(nearest_swap, distance);
      }
      word = {record.cycle, window_number_, sheet_number_};
    }
  }
  if (nearest_swap <= kDistances) coverage_.hit(swap_distance_ + nearest_swap - kLeastSwap);
  if (nearest > kDistances) return;
  if (dense) coverage_.hit(dense_ + nearest - 1);
  if (!dense && nearest >= 2 && nearest <= 4) coverage_.hit(bubbled_ + nearest - 2);
  if (nearest <= 4) coverage_.hit((met == inside ? whole_overlap_ : part_overlap_) + nearest - 1);
}

void CycleCoverage::on_sheet(const cmodel::SheetCycles& sheet) {
  if (every_sample_) return;  // nothing is swapped or walked
  if (sheet.windows < kSheetSizes) coverage_.hit(windows_in_sheet_ + sheet.windows);
  if (sheet.begun > sheet.offered) coverage_.hit(buffer_wait_ + length(sheet.begun - sheet.offered));
  const std::uint64_t soonest = sheet.closed + path_delay(config_) + cmodel::stages::kWalk;
  coverage_.hit(sheet.walk_from > soonest ? walk_waits_ : walk_at_once_);
  if (sheet.blocks == 0) coverage_.hit(empty_walk_);
  if (walk_known_) {
    if (windows_before_walk_ < sheet.windows)
      coverage_.hit(walk_begins_ + std::min(windows_before_walk_, walk_begins(config_)));
    else
      coverage_.hit(walk_begins_after_);
    if (windows_before_end_ < sheet.windows)
      coverage_.hit(walk_ends_ + std::min(windows_before_end_, kWalkEnds));
    else
      coverage_.hit(walk_ends_after_);
    if (before_.blocks > 0 && before_.walk_to - before_.walk_from > sheet.windows) coverage_.hit(compositor_bound_);
  }
  before_ = sheet;
  walk_known_ = true;
  windows_before_walk_ = windows_before_end_ = 0;
  ++sheet_number_;
}

void CycleCoverage::pixel_beat(std::uint64_t cycle) {
  if (pixel_beats_.empty() || pixel_beats_.back() != cycle) pixel_beats_.push_back(cycle);
}

void CycleCoverage::on_tile(const cmodel::TileCycles& tile) {
  std::uint64_t shown = tile.closed + cmodel::stages::kPixel + (sliced_ ? 1 : 0);
  std::size_t held = 0;
  for (std::size_t i = 0; i < pixel_beats_.size(); ++i) {
    if (pixel_beats_[i] > shown) {
      ++held;
      const bool first = i == 0, last = i + 1 == pixel_beats_.size();
      if (first) coverage_.hit(first_beat_held_);
      if (last) coverage_.hit(last_beat_held_);
      if (!first && !last) coverage_.hit(middle_beat_held_);
      coverage_.hit(hold_length_ + length(pixel_beats_[i] - shown));
    }
    shown = pixel_beats_[i] + 1;
  }
  if (held == 0) coverage_.hit(never_held_);
  if (held == pixel_beats_.size()) coverage_.hit(every_held_);
  if (pixel_beats_.size() == 1) coverage_.hit(one_beat_);
  pixel_beats_.clear();
}

void CycleCoverage::stalls(const cmodel::StallCounters& stalls) {
  Id id = stall_;
  stalls.for_each(config_, [&](const char* name, std::uint64_t count, const char*) {
    if (can_rise(config_, name)) coverage_.hit(id++, count);
  });
}

ResetCoverage::ResetCoverage(const cmodel::Config& config, Coverage& coverage)
    : coverage_(coverage), delay_(path_delay(config)) {
  between_ = coverage.declare("reset", "between_tiles");
  payload_ = coverage.declare("reset", "inside_a_table");
  tile_ = coverage.declare("reset", "inside_a_tile");
  sheet_ = coverage.declare("reset", "inside_a_sheet");
  windows_ = coverage.declare("reset", "with_windows_in_flight");
  walk_ = coverage.declare("reset", "while_compositing");
  picture_ = coverage.declare("reset", "while_pixels_go_out");
}

void ResetCoverage::on_beat(const cmodel::BeatCycles& beat) {
  last_ = beat;
  if (beat.payload) return;
  switch (beat.opcode) {
    case cmodel::Opcode::BeginTile:
      in_tile_ = true;
      break;
    case cmodel::Opcode::EndTile:
      in_tile_ = false;
      break;
    case cmodel::Opcode::BeginSheet:
      in_sheet_ = true;
      break;
    case cmodel::Opcode::EndSheet:
      in_sheet_ = false;
      break;
    case cmodel::Opcode::Splat:
    case cmodel::Opcode::Ellipse:
      last_splat_ = beat.left;
      break;
    default:
      break;
  }
}

void ResetCoverage::on_sheet(const cmodel::SheetCycles& sheet) {
  walk_from_ = sheet.walk_from;
  walk_to_ = std::max(walk_to_, sheet.walk_to);
}

void ResetCoverage::on_tile(const cmodel::TileCycles& tile) {
  picture_from_ = tile.picture_from;
  picture_to_ = tile.picture_to;
}

void ResetCoverage::reset(std::uint64_t cycle) {
  const bool in_table = last_.payload || last_.opcode == cmodel::Opcode::LoadTable;
  coverage_.hit(in_sheet_ ? sheet_ : in_tile_ ? tile_ : in_table ? payload_ : between_);
  if (last_splat_ > 0 && cycle <= last_splat_ + delay_ + cmodel::stages::kSheet) coverage_.hit(windows_);
  if (cycle >= walk_from_ && cycle < walk_to_) coverage_.hit(walk_);
  if (cycle >= picture_from_ && cycle < picture_to_) coverage_.hit(picture_);
}

}  // namespace fastsplat::testbench
