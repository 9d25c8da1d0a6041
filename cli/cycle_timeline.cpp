// SPDX-License-Identifier: Apache-2.0
#include "cli/cycle_timeline.hpp"

#include <nlohmann/json.hpp>

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void CycleTimeline::on_beat(const cmodel::BeatCycles& beat) {
  if (next_ != nullptr) next_->on_beat(beat);
}

void CycleTimeline::on_verdict(const cmodel::VerdictCycles& verdict) {
  if (next_ != nullptr) next_->on_verdict(verdict);
}

void CycleTimeline::on_sheet(const cmodel::SheetCycles& sheet) {
  sheets_.size() < kMostSheets ? sheets_.push_back(sheet) : void(++more_sheets_);
  if (next_ != nullptr) next_->on_sheet(sheet);
}

void CycleTimeline::on_tile(const cmodel::TileCycles& tile) {
  tiles_.size() < kMostTiles ? tiles_.push_back(tile) : void(++more_tiles_);
  if (next_ != nullptr) next_->on_tile(tile);
}

Json CycleTimeline::json() const {
  Json out{
      {"sheet_columns", {"tile", "sheet", "offered", "begun", "closed", "windows", "blocks", "walk_from", "walk_to"}},
      {"sheets", Json::array()},
      {"sheets_left_out", more_sheets_},
      {"tile_columns", {"tile", "begun", "closed", "picture_from", "picture_to"}},
      {"tiles", Json::array()},
      {"tiles_left_out", more_tiles_}};
  for (const auto& s : sheets_)
    out["sheets"].push_back(
        {s.tile, s.sheet, s.offered, s.begun, s.closed, s.windows, s.blocks, s.walk_from, s.walk_to});
  for (const auto& t : tiles_) out["tiles"].push_back({t.tile, t.begun, t.closed, t.picture_from, t.picture_to});
  return out;
}

}  // namespace fastsplat::cli
