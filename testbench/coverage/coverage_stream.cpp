// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_stream.hpp"

#include <set>

#include "cmodel/classify/classify_tables.hpp"
#include "cmodel/classify/pattern_tables.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "testbench/device/words.hpp"

namespace fastsplat::testbench {
namespace {

std::size_t words_in_last_beat(std::size_t words) { return (words + cmodel::kBeatWords - 1) % cmodel::kBeatWords; }

template <class Kind>
using Names = std::vector<std::pair<Kind, const char*>>;

Names<cmodel::Table> tables_of(const cmodel::Config& config) {
  using cmodel::Table;
  Names<Table> out{{Table::Rlut, "rlut"}, {Table::Radial, "radial"}, {Table::Factor, "factor"}};
  const Names<Table> densities{{Table::Classify, "classify"},
                               {Table::Root, "root"},
                               {Table::Glint, "glint"},
                               {Table::Lighting, "lighting"},
                               {Table::Sheets, "sheets"}};
  const Names<Table> patterns{{Table::Nodes, "nodes"}, {Table::Pattern, "pattern"}};
  if (config.classifies()) out.insert(out.end(), densities.begin(), densities.end());
  if (config.has_patterns()) out.insert(out.end(), patterns.begin(), patterns.end());
  return out;
}

Names<cmodel::Mode> modes_of(const cmodel::Config& config) {
  using cmodel::Mode;
  Names<Mode> out{{Mode::Exponential, "exponential"}, {Mode::Additive, "additive"}, {Mode::Sum, "sum"}};
  const Names<Mode> samples{{Mode::SampleExponential, "every_sample_exponential"},
                            {Mode::SampleAdditive, "every_sample_additive"}};
  const Names<Mode> densities{{Mode::DensityExponential, "density_exponential"},
                              {Mode::DensityAdditive, "density_additive"}};
  if (config.composite_every_sample != 0) out.insert(out.end(), samples.begin(), samples.end());
  if (config.classifies()) out.insert(out.end(), densities.begin(), densities.end());
  return out;
}

/// Fills of a table's last beat (0: one word, 1: two ...) that the configuration's tables can have. SHEETS is left out:
/// its length depends on the frame.
std::set<std::size_t> last_beats(const cmodel::Config& config) {
  std::set<std::size_t> out{words_in_last_beat(static_cast<std::size_t>(config.radial_words())),
                            words_in_last_beat(static_cast<std::size_t>(config.opacity_segments) + 1)};
  for (int columns = config.lanes; columns <= config.rlut_columns; columns += config.lanes)
    out.insert(words_in_last_beat(static_cast<std::size_t>(columns) * static_cast<std::size_t>(config.phases)));
  for (const auto& [table, name] : tables_of(config)) {
    const bool pattern = table == cmodel::Table::Nodes || table == cmodel::Table::Pattern;
    const auto words = pattern ? cmodel::pattern_words(config, table) : cmodel::classify_words(config, table);
    if (words > 0) out.insert(words_in_last_beat(static_cast<std::size_t>(words)));  // else: above, or SHEETS
  }
  return out;
}

}  // namespace

StreamCoverage::StreamCoverage(const cmodel::Config& config, Coverage& coverage)
    : config_(config),
      coverage_(coverage),
      sets_(static_cast<std::size_t>(config.rlut_sets)),
      extents_(static_cast<std::size_t>(config.rlut_sets)) {
  record_ = coverage.bins().size();
  // In the order of cmodel::Record's alternatives.
  for (const auto& record : cmodel::record_layouts())
    if (record.opcode != cmodel::Opcode::Ellipse || config.has_ellipses()) coverage.declare("record", record.name);
  for (const auto& [table, name] : tables_of(config))
    table_kind_.at(static_cast<std::size_t>(table)) = coverage.declare("table", name);
  for (const std::size_t words : last_beats(config))
    coverage.declare("table", "last_beat_of_" + std::to_string(words + 1));
  loaded_again_ = coverage.declare("table", "set_loaded_again");
  first_columns_ = coverage.declare("table", "set_in_first_columns");
  last_columns_ = coverage.declare("table", "set_in_last_columns");
  for (const auto& [mode, name] : modes_of(config))
    mode_.at(static_cast<std::size_t>(mode)) = coverage.declare("tile", name);
  if (config.classifies()) {
    left_ = coverage.declare("density", "tile_at_the_left_edge");
    right_ = coverage.declare("density", "tile_at_the_right_edge");
    top_ = coverage.declare("density", "tile_at_the_top_edge");
    bottom_ = coverage.declare("density", "tile_at_the_bottom_edge");
    within_ = coverage.declare("density", "tile_at_no_edge");
    neighbours_ = coverage.declare("density", "sheet_behind_its_neighbour");
    missing_ = coverage.declare("density", "sheet_behind_a_missing_one");
    alone_ = coverage.declare("density", "sheet_alone");
  }
  full_width_ = coverage.declare("tile", "full_width");
  full_height_ = coverage.declare("tile", "full_height");
  partial_width_ = coverage.declare("tile", "partial_block_width");
  partial_height_ = coverage.declare("tile", "partial_block_height");
  one_pixel_ = coverage.declare("tile", "one_pixel");
  no_sheet_ = coverage.declare("tile", "without_sheet");
  next_tile_ = coverage.declare("tile", "after_another");
  empty_sheet_ = coverage.declare("sheet", "empty");
  one_splat_ = coverage.declare("sheet", "of_one_splat");
  number_gap_ = coverage.declare("sheet", "number_skips");
  number_zero_ = coverage.declare("sheet", "number_zero");
  cull_first_ = coverage.declare("cull", "before_all_splats");
  cull_between_ = coverage.declare("cull", "between_splats");
  cull_last_ = coverage.declare("cull", "after_all_splats");
  if (config.rlut_sets > 1) {
    overlap_ = coverage.declare("table", "sets_overlap");
    first_set_ = coverage.declare("set", "first");
    last_set_ = coverage.declare("set", "last");
    other_set_ = coverage.declare("set", "another_than_before");
  }
  colour_zero_ = coverage.bins().size();
  for (const char* channel : kChannels) coverage.declare("colour", std::string(channel) + "_zero");
  colour_largest_ = coverage.bins().size();
  for (const char* channel : kChannels) coverage.declare("colour", std::string(channel) + "_largest");
}

void StreamCoverage::on_record(const cmodel::Record& record) {
  constexpr std::size_t kEllipse = 5;  // its alternative of cmodel::Record
  static_assert(std::is_same_v<std::variant_alternative_t<kEllipse, cmodel::Record>, cmodel::EllipseRecord>);
  const bool skipped = record.index() > kEllipse && !config_.has_ellipses();
  coverage_.hit(record_ + record.index() - (skipped ? 1 : 0));
  if (const auto* splat_record = std::get_if<cmodel::SplatRecord>(&record)) {
    splat(*splat_record);
  } else if (const auto* ellipse = std::get_if<cmodel::EllipseRecord>(&record)) {
    shape(ellipse->colour);
  } else if (const auto* load = std::get_if<cmodel::LoadTable>(&record)) {
    table(*load);
  } else if (const auto* frame = std::get_if<cmodel::BeginFrame>(&record)) {
    frame_width_ = frame->width;
    frame_height_ = frame->height;
  } else if (const auto* begin = std::get_if<cmodel::BeginTile>(&record)) {
    tile(*begin);
  } else if (const auto* begin_sheet = std::get_if<cmodel::BeginSheet>(&record)) {
    sheet(*begin_sheet);
  } else if (const auto* end = std::get_if<cmodel::EndSheet>(&record)) {
    end_sheet(*end);
  } else if (const auto* end_tile = std::get_if<cmodel::EndTile>(&record)) {
    if (end_tile->sheets == 0) coverage_.hit(no_sheet_);
    if (densities_ && end_tile->sheets == 1) coverage_.hit(alone_);
  } else if (std::holds_alternative<cmodel::CullBlock>(record)) {
    if (splats_ == 0) coverage_.hit(cull_first_);
    cull_pending_ = true;
  }
}

void StreamCoverage::table(const cmodel::LoadTable& table) {
  coverage_.hit(table_kind_.at(static_cast<std::size_t>(table.table)));
  if (table.table != cmodel::Table::Sheets)
    coverage_.hit(
        coverage_.declare("table", "last_beat_of_" + std::to_string(words_in_last_beat(table.words.size()) + 1)));
  if (table.table != cmodel::Table::Rlut) return;
  const auto extent = cmodel::window_geometry(config_, table.radius.rho).padded;
  const std::uint32_t base = table.radius.base, end = base + extent;
  if (sets_[table.radius.set].rho != 0) coverage_.hit(loaded_again_);
  if (base == 0) coverage_.hit(first_columns_);
  if (end == static_cast<std::uint32_t>(config_.rlut_columns)) coverage_.hit(last_columns_);
  for (std::size_t other = 0; other < sets_.size(); ++other) {
    if (other == table.radius.set || sets_[other].rho == 0) continue;
    if (sets_[other].base < end && base < sets_[other].base + extents_[other]) coverage_.hit(overlap_);
  }
  sets_[table.radius.set] = table.radius;
  extents_[table.radius.set] = extent;
}

void StreamCoverage::tile(const cmodel::BeginTile& tile) {
  coverage_.hit(mode_.at(static_cast<std::size_t>(tile.mode)));
  if (tile.width == config_.tile_width) coverage_.hit(full_width_);
  if (tile.height == config_.tile_height) coverage_.hit(full_height_);
  if (tile.width % config_.lanes != 0) coverage_.hit(partial_width_);
  if (tile.height % config_.lanes != 0) coverage_.hit(partial_height_);
  if (tile.width == 1 && tile.height == 1) coverage_.hit(one_pixel_);
  if (tiles_++ > 0) coverage_.hit(next_tile_);
  sheets_ = 0;
  densities_ = cmodel::holds_densities(tile.mode);
  if (!densities_) return;
  const bool left = tile.x == 0, right = tile.x + tile.width == frame_width_;
  const bool top = tile.y == 0, bottom = tile.y + tile.height == frame_height_;
  if (left) coverage_.hit(left_);
  if (right) coverage_.hit(right_);
  if (top) coverage_.hit(top_);
  if (bottom) coverage_.hit(bottom_);
  if (!left && !right && !top && !bottom) coverage_.hit(within_);
}

void StreamCoverage::sheet(const cmodel::BeginSheet& sheet) {
  if (sheet.sheet == 0) coverage_.hit(number_zero_);
  const bool gap = sheet.sheet != number_ + 1;
  if (sheets_ > 0 && gap) coverage_.hit(number_gap_);
  if (sheets_ > 0 && densities_) coverage_.hit(gap ? missing_ : neighbours_);
  ++sheets_;
  number_ = sheet.sheet;
  splats_ = 0;
  cull_pending_ = circle_ = false;
}

void StreamCoverage::splat(const cmodel::SplatRecord& splat) {
  if (config_.rlut_sets > 1) {
    if (splat.set == 0) coverage_.hit(first_set_);
    if (splat.set + 1 == sets_.size()) coverage_.hit(last_set_);
    if (circle_ && splat.set != set_) coverage_.hit(other_set_);
  }
  circle_ = true;
  set_ = splat.set;
  shape(splat.colour);
}

void StreamCoverage::shape(const std::array<std::uint32_t, 4>& colour) {
  if (cull_pending_ && splats_ > 0) coverage_.hit(cull_between_);
  cull_pending_ = false;
  ++splats_;
  const auto largest = static_cast<std::uint32_t>(config_.colour_format().max);
  for (std::size_t c = 0; c < colour.size(); ++c) {
    if (colour[c] == 0) coverage_.hit(colour_zero_ + c);
    if (colour[c] == largest) coverage_.hit(colour_largest_ + c);
  }
}

void StreamCoverage::end_sheet(const cmodel::EndSheet& end) {
  if (end.splats == 0) coverage_.hit(empty_sheet_);
  if (end.splats == 1) coverage_.hit(one_splat_);
  if (cull_pending_ && splats_ > 0) coverage_.hit(cull_last_);
}

}  // namespace fastsplat::testbench
