// SPDX-License-Identifier: Apache-2.0
// Coverage of time, from the cycle model's events: hazards by distance, sheet swaps by phase, bubbles, waits, pixel
// back-pressure, and what a reset interrupts (docs/microarchitecture.md).
#pragma once

#include <optional>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/coverage/coverage.hpp"
#include "testbench/coverage/coverage_samples.hpp"

namespace fastsplat::testbench {

class CycleCoverage final : public cmodel::CycleSink, public cmodel::TapSink {
 public:
  CycleCoverage(const cmodel::Config& config, bool sliced, Coverage& coverage);

  void on_beat(const cmodel::BeatCycles& beat) override;
  void on_sheet(const cmodel::SheetCycles& sheet) override;
  void on_tile(const cmodel::TileCycles& tile) override;
  void on_tap(const cmodel::TapRecord& record) override;
  void begin_tile(const cmodel::BeginTile& tile);
  /// The device's own stall counters, at the end.
  void stalls(const cmodel::StallCounters& stalls);

 private:
  using Id = Coverage::Id;
  void window(const cmodel::TapRecord& record);
  void hazards(const cmodel::TapRecord& record);
  void pixel_beat(std::uint64_t cycle);

  /// When a word of the current or the previous sheet was last written.
  struct Written {
    std::uint64_t cycle = 0, window = 0, sheet = 0;  ///< sheets and windows counted over the run, from 1
  };
  cmodel::Config config_;
  bool sliced_;
  Coverage& coverage_;
  std::size_t columns_;
  int width_ = 0, height_ = 0;
  bool every_sample_ = false;  ///< of the tile
  std::optional<SampleCoverage> samples_;
  std::vector<Written> written_;
  std::uint64_t window_number_ = 0, sheet_number_ = 1;

  bool walk_known_ = false;  ///< of the sheet before, in the same tile
  cmodel::SheetCycles before_;
  std::uint64_t windows_before_walk_ = 0, windows_before_end_ = 0;
  std::vector<std::uint64_t> pixel_beats_;

  Id dense_ = 0, bubbled_ = 0, swap_distance_ = 0, whole_overlap_ = 0, part_overlap_ = 0;
  Id windows_in_sheet_ = 0, walk_begins_ = 0, walk_ends_ = 0, walk_begins_after_ = 0, walk_ends_after_ = 0;
  Id walk_at_once_ = 0, walk_waits_ = 0, buffer_wait_ = 0, empty_walk_ = 0, compositor_bound_ = 0;
  Id bubble_ = 0, bubble_length_ = 0, held_ = 0;
  Id wait_begin_tile_ = 0, wait_end_tile_ = 0;
  Id first_beat_held_ = 0, middle_beat_held_ = 0, last_beat_held_ = 0, hold_length_ = 0, never_held_ = 0,
     every_held_ = 0, one_beat_ = 0;
  Id stall_ = 0;
};

/// The device's activity in the cycle in which a warm reset came.
class ResetCoverage final : public cmodel::CycleSink {
 public:
  ResetCoverage(const cmodel::Config& config, Coverage& coverage);

  void on_beat(const cmodel::BeatCycles& beat) override;
  void on_sheet(const cmodel::SheetCycles& sheet) override;
  void on_tile(const cmodel::TileCycles& tile) override;
  /// Reset in `cycle`, after the beats seen.
  void reset(std::uint64_t cycle);

 private:
  Coverage& coverage_;
  std::uint64_t delay_;  ///< of the splat path
  Coverage::Id between_ = 0, payload_ = 0, tile_ = 0, sheet_ = 0, windows_ = 0, walk_ = 0, picture_ = 0;
  cmodel::BeatCycles last_;
  bool in_tile_ = false, in_sheet_ = false;
  std::uint64_t last_splat_ = 0, walk_to_ = 0, walk_from_ = 0, picture_from_ = 0, picture_to_ = 0;
};

}  // namespace fastsplat::testbench
