// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_cull.hpp"

#include "cmodel/cull/cull_unit.hpp"

namespace fastsplat::testbench {
namespace {

/// Offsets from the first bin of each kind, as they are declared.
enum SetBin { SetHidden, SetSeen, SetOfNone, SetBeside, SetAcrossHidden, SetAcrossSeen, SetWithoutMap };
enum SplatBin { SplatHidden, SplatSeen, SplatOfHiddenSet };  // of ellipses, too
enum WindowBin { WindowsSome, WindowsNone };
enum MapBin { MapUnchanged, MapChanged, MapFromALaterRow };

}  // namespace

CullCoverage::CullCoverage(const cmodel::Config& config, Coverage& coverage)
    : coverage_(coverage), lanes_(config.lanes) {
  const auto declare = [&](std::initializer_list<const char*> names) {
    const Id first = coverage.bins().size();
    for (const char* name : names) coverage.declare("culling", name);
    return first;
  };
  set_ = declare({"set_hidden", "set_seen", "set_of_no_splat", "set_beside_the_tile", "set_across_the_edge_hidden",
                  "set_across_the_edge_seen", "set_before_there_is_a_map"});
  splat_ = declare({"splat_hidden", "splat_seen", "splat_of_a_hidden_set"});
  if (config.has_ellipses()) ellipse_ = declare({"ellipse_hidden", "ellipse_seen", "ellipse_of_a_hidden_set"});
  window_ = declare({"windows_some_hidden", "windows_none_hidden"});
  map_ = declare({"map_unchanged_by_a_sheet", "map_changed_from_the_first_row", "map_changed_from_a_later_row"});
  jump_ = declare({"tag_jump"});
  waits_ = declare({"begin_sheet_waits_for_its_table"});
}

void CullCoverage::after(const cmodel::Record& record, const cmodel::CullCounts& found, const cmodel::CullLog& log) {
  if (const auto* tile = std::get_if<cmodel::BeginTile>(&record)) {
    tile_ = *tile;
    sheets_ = 0;
  }
  if (cmodel::culls_in(tile_.mode)) {
    if (const auto* block = std::get_if<cmodel::CullBlock>(&record))
      set(*block, found.hidden_sets > before_.hidden_sets);
    if (const auto* one = std::get_if<cmodel::SplatRecord>(&record)) {
      splat(splat_, one->tag, found);
      if (found.dropped == before_.dropped && found.hidden_splats == before_.hidden_splats)
        coverage_.hit(window_ + (found.hidden_windows > before_.hidden_windows ? WindowsSome : WindowsNone));
    }
    if (const auto* one = std::get_if<cmodel::EllipseRecord>(&record)) splat(ellipse_, one->tag, found);
    const cmodel::CullAnswers* answers = log.find(tile_.tile);
    if (std::holds_alternative<cmodel::EndSheet>(record) && answers != nullptr) sheet(*answers);
  }
  if (const auto* one = std::get_if<cmodel::SplatRecord>(&record)) next_tag_ = one->tag + 1;
  if (const auto* one = std::get_if<cmodel::EllipseRecord>(&record)) next_tag_ = one->tag + 1;
  before_ = found;
}

void CullCoverage::set(const cmodel::CullBlock& set, bool hidden) {
  coverage_.hit(set_ + (hidden ? SetHidden : SetSeen));
  if (set.splats == 0) coverage_.hit(set_ + SetOfNone);
  const std::int64_t right = std::int64_t{set.x} + set.width, bottom = std::int64_t{set.y} + set.height;
  const bool beside = right <= 0 || bottom <= 0 || set.x >= tile_.width || set.y >= tile_.height;
  const bool across = !beside && (set.x < 0 || set.y < 0 || right > tile_.width || bottom > tile_.height);
  if (beside) coverage_.hit(set_ + SetBeside);
  if (across) coverage_.hit(set_ + (hidden ? SetAcrossHidden : SetAcrossSeen));
  if (!beside && sheets_ < 2) coverage_.hit(set_ + SetWithoutMap);
}

void CullCoverage::splat(Id bins, std::uint32_t tag, const cmodel::CullCounts& found) {
  if (tag != next_tag_ && tag > next_tag_) coverage_.hit(jump_);
  coverage_.hit(bins + (found.dropped > before_.dropped               ? SplatOfHiddenSet
                        : found.hidden_splats > before_.hidden_splats ? SplatHidden
                                                                      : SplatSeen));
}

void CullCoverage::sheet(const cmodel::CullAnswers& answers) {
  const int row = answers.first_row(sheets_++), rows = (tile_.height + lanes_ - 1) / lanes_;
  coverage_.hit(map_ + (row >= rows ? MapUnchanged : row == 0 ? MapChanged : MapFromALaterRow));
}

void CullCoverage::finish(const cmodel::CycleAccount& account) {
  if (account.map > 0) coverage_.hit(waits_);
}

}  // namespace fastsplat::testbench
