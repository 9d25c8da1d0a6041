// SPDX-License-Identifier: Apache-2.0
// A run's timeline in the JSON result, for the report to draw: when each sheet and tile passed through the device.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"

namespace fastsplat::cli {

/// Keeps the first sheets and tiles and counts the others, so that reports stay small.
class CycleTimeline final : public cmodel::CycleSink {
 public:
  static constexpr std::size_t kMostSheets = 5000, kMostTiles = 1000;

  /// Forwards all callbacks to `next`, unless null.
  explicit CycleTimeline(cmodel::CycleSink* next = nullptr) : next_(next) {}

  void on_beat(const cmodel::BeatCycles& beat) override;
  void on_verdict(const cmodel::VerdictCycles& verdict) override;
  void on_sheet(const cmodel::SheetCycles& sheet) override;
  void on_tile(const cmodel::TileCycles& tile) override;

  /// {"sheets", "tiles": rows whose columns are named by "sheet_columns" and "tile_columns"; "sheets_left_out",
  /// "tiles_left_out": counts}.
  nlohmann::ordered_json json() const;

 private:
  cmodel::CycleSink* next_;
  std::vector<cmodel::SheetCycles> sheets_;
  std::vector<cmodel::TileCycles> tiles_;
  std::uint64_t more_sheets_ = 0, more_tiles_ = 0;
};

}  // namespace fastsplat::cli
