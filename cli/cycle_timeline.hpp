// A run's timeline as part of the result: when each sheet and each tile went through the device, as the report draws
// it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"

namespace fastsplat::cli {

/// Keeps the first sheets and tiles, counts the others: a report is to stay small.
class CycleTimeline final : public cmodel::CycleSink {
 public:
  static constexpr std::size_t kMostSheets = 5000, kMostTiles = 1000;

  /// What is seen is passed on to `next` too; null: to none.
  explicit CycleTimeline(cmodel::CycleSink* next = nullptr) : next_(next) {}

  void on_beat(const cmodel::BeatCycles& beat) override;
  void on_verdict(const cmodel::VerdictCycles& verdict) override;
  void on_sheet(const cmodel::SheetCycles& sheet) override;
  void on_tile(const cmodel::TileCycles& tile) override;

  /// {"sheets", "tiles": a row each, named by "sheet_columns" and "tile_columns"; "sheets_left_out", "tiles_left_out"}.
  nlohmann::ordered_json json() const;

 private:
  cmodel::CycleSink* next_;
  std::vector<cmodel::SheetCycles> sheets_;
  std::vector<cmodel::TileCycles> tiles_;
  std::uint64_t more_sheets_ = 0, more_tiles_ = 0;
};

}  // namespace fastsplat::cli
