// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_splat.hpp"

#include <algorithm>
#include <string>

#include "testbench/device/words.hpp"

namespace fastsplat::testbench {
namespace {

/// Where a window lies on one axis of the tile. `Both`: wider than the tile.
enum Axis : std::size_t { Before, Low, Inside, High, After, Both };
constexpr const char* kAxes[] = {"before", "low", "inside", "high", "after", "both"};

}  // namespace

SplatCoverage::SplatCoverage(const cmodel::Config& config, Coverage& coverage)
    : config_(config),
      coverage_(coverage),
      columns_(static_cast<std::size_t>(config.tile_width)),
      sites_(config),
      rlut_(config),
      sums_(columns_ * static_cast<std::size_t>(config.tile_height)) {
  const std::int64_t largest = config.position_format().max;
  snap_x_ = RoundingPoint(coverage, "snap", "x_", sites_[cmodel::Site::Snap], largest);
  snap_y_ = RoundingPoint(coverage, "snap", "y_", sites_[cmodel::Site::Snap], largest);
  centre_ = coverage.bins().size();
  for (const char* name : {"x_least", "y_least", "x_greatest", "y_greatest"}) coverage.declare("centre", name);
  phase_x_ = coverage.declare_range("phase", "x_", static_cast<std::size_t>(config.phases));
  phase_y_ = coverage.declare_range("phase", "y_", static_cast<std::size_t>(config.phases));
  bank_ = coverage.bins().size();
  for (int y = 0; y < config.lanes; ++y) {
    for (int x = 0; x < config.lanes; ++x) coverage.declare("bank", "x" + std::to_string(x) + "_y" + std::to_string(y));
  }
  // A window of two pixels cannot reach over both edges of a tile.
  const std::size_t classes = config.lanes > 2 ? Both + 1 : Both;
  edges_.resize((Both + 1) * (Both + 1));
  for (std::size_t y = 0; y < classes; ++y) {
    for (std::size_t x = 0; x < classes; ++x)
      edges_[y * (Both + 1) + x] = coverage.declare("edge", std::string("x_") + kAxes[x] + "_y_" + kAxes[y]);
  }
  // Windows per side of a footprint; stimuli go up to six, more are repetitions.
  windows_per_side_ = coverage.bins().size();
  for (int side = 1; side <= std::min(6, config.rlut_columns / config.lanes); ++side)
    coverage.declare("footprint", "windows_per_side_" + std::to_string(side));
  rlut_zero_ = coverage.declare("rlut", "word_zero");
  rlut_rim_ = coverage.declare("rlut", "word_at_rim");
  rlut_first_ = coverage.declare("rlut", "first_column_read");
  rlut_last_ = coverage.declare("rlut", "last_column_read");
  index_first_ = coverage.declare("radial", "first_entry");
  index_last_ = coverage.declare("radial", "last_entry");
  index_last_inside_ = coverage.declare("radial", "last_q_inside");
  index_at_rim_ = coverage.declare("radial", "q_at_rim");
  index_beyond_ = coverage.declare("radial", "q_beyond_rim");
  index_furthest_ = coverage.declare("radial", "q_at_twice_the_rim");
  weight_zero_ = coverage.declare("radial", "weight_zero_inside");
  weight_largest_ = coverage.declare("radial", "weight_largest");
  if (config.interpolates()) interpolation_.emplace(config, coverage);
  const std::int64_t product = config.colour_format().max * config.weight_format().max;
  for (std::size_t c = 0; c < 4; ++c)
    product_[c] =
        RoundingPoint(coverage, "product", std::string(kChannels[c]) + "_", sites_[cmodel::Site::Product], product);
  const auto per_channel = [&](const char* name) {
    const Id first = coverage.bins().size();
    for (const char* channel : kChannels) coverage.declare("sum", std::string(channel) + name);
    return first;
  };
  sum_saturated_ = per_channel("_saturated");
  sum_alone_ = per_channel("_alone_saturated");
  sum_exactly_ = per_channel("_exactly_largest");
  sum_stays_ = per_channel("_stays_largest");
  sum_all_ = coverage.declare("sum", "all_saturated");
  if (config.has_ellipses()) ellipses_.emplace(config, coverage);
}

void SplatCoverage::load(const cmodel::LoadTable& table) {
  if (interpolation_) interpolation_->load(table);
  if (table.table != cmodel::Table::Rlut) return;
  rlut_.load(table);
  base_[table.radius.set] = table.radius.base;
}

void SplatCoverage::begin_tile(const cmodel::BeginTile& tile) { tile_ = tile; }

void SplatCoverage::splat(const cmodel::SplatRecord& record) {
  record_ = record;
  if (in_ellipse_) ellipses_->circle_follows();
  in_ellipse_ = false;
  after_circle_ = true;
  snap_x_.sample(coverage_, record.x);
  snap_y_.sample(coverage_, record.y);
  const auto format = config_.position_format();
  if (record.x == format.min) coverage_.hit(centre_);
  if (record.y == format.min) coverage_.hit(centre_ + 1);
  if (record.x == format.max) coverage_.hit(centre_ + 2);
  if (record.y == format.max) coverage_.hit(centre_ + 3);
  const auto side = rlut_.extent(record.set) / static_cast<std::uint32_t>(config_.lanes);
  if (side <= 6) coverage_.hit(windows_per_side_ + side - 1);
}

void SplatCoverage::ellipse(const cmodel::EllipseRecord& record) {
  record_.colour = record.colour;
  ellipses_->record(record, after_circle_);
  in_ellipse_ = true;
  after_circle_ = false;
}

void SplatCoverage::on_tap(const cmodel::TapRecord& record) {
  if (record.tap == cmodel::Tap::Snap) snapped(record);
  if (record.tap == cmodel::Tap::Footprint) footprint(record);
  if (record.tap == cmodel::Tap::Sheet) accumulated(record);
}

void SplatCoverage::snapped(const cmodel::TapRecord& record) {
  x0_ = record.x;
  y0_ = record.y;
  if (in_ellipse_) return;
  mx_ = record.payload[2];
  my_ = record.payload[3];
  coverage_.hit(phase_x_ + mx_);
  coverage_.hit(phase_y_ + my_);
}

std::size_t SplatCoverage::axis_class(std::int32_t origin, int side) const {
  const std::int32_t end = origin + config_.lanes;
  if (end <= 0) return Before;
  if (origin >= side) return After;
  if (origin < 0) return end > side ? Both : Low;
  return end > side ? High : Inside;
}

void SplatCoverage::place(std::int32_t x, std::int32_t y) {
  const std::int32_t mask = config_.lanes - 1;
  coverage_.hit(bank_ + static_cast<std::size_t>((y & mask) * config_.lanes + (x & mask)));
  coverage_.hit(edges_[axis_class(y, tile_.height) * (Both + 1) + axis_class(x, tile_.width)]);
}

void SplatCoverage::footprint(const cmodel::TapRecord& record) {
  place(record.x, record.y);
  weights_.assign(record.payload.begin(), record.payload.end());
  const auto column = static_cast<std::uint32_t>(record.x - x0_), row = static_cast<std::uint32_t>(record.y - y0_);
  if (in_ellipse_) return ellipses_->window(column, row, interpolation_ ? &*interpolation_ : nullptr);
  const auto columns = rlut_.read(record_.set, mx_, column), rows = rlut_.read(record_.set, my_, row);
  const auto rim = static_cast<std::uint32_t>(config_.rlut_rim());
  for (const auto words : {columns, rows}) {
    for (const std::uint32_t word : words) {
      if (word == 0) coverage_.hit(rlut_zero_);
      if (word == rim) coverage_.hit(rlut_rim_);
    }
  }
  const std::uint32_t base = base_[record_.set], lanes = static_cast<std::uint32_t>(config_.lanes);
  const std::uint32_t end = base + std::max(column, row) + lanes;
  if (base + std::min(column, row) == 0) coverage_.hit(rlut_first_);
  if (end == static_cast<std::uint32_t>(config_.rlut_columns)) coverage_.hit(rlut_last_);
  const auto largest = static_cast<std::uint32_t>(config_.weight_format().max);
  std::size_t lane = 0;
  for (const std::uint32_t y : rows) {
    for (const std::uint32_t x : columns) {
      const std::uint32_t q = x + y, weight = weights_[lane++];
      if (q >= rim) {
        coverage_.hit(q == rim ? index_at_rim_ : q == 2 * rim ? index_furthest_ : index_beyond_);
        continue;
      }
      const std::uint32_t index = q >> config_.rlut_guard_bits;
      if (index == 0) coverage_.hit(index_first_);
      if (index + 1 == static_cast<std::uint32_t>(config_.radial_entries)) coverage_.hit(index_last_);
      if (q + 1 == rim) coverage_.hit(index_last_inside_);
      if (interpolation_) interpolation_->weight(InterpolationCoverage::Circle, q);
      if (weight == 0) coverage_.hit(weight_zero_);
      if (weight == largest) coverage_.hit(weight_largest_);
    }
  }
}

std::optional<cmodel::SheetWord> SplatCoverage::sample(std::size_t lane) {
  const std::uint32_t weight = weights_[lane];
  if (weight == 0) return std::nullopt;
  cmodel::SheetWord products{};
  for (std::size_t c = 0; c < 4; ++c)
    products[c] =
        static_cast<std::uint32_t>(product_[c].sample(coverage_, std::int64_t{record_.colour[c]} * weight).word);
  return products;
}

void SplatCoverage::accumulated(const cmodel::TapRecord& record) {
  for (int j = 0; j < config_.lanes; ++j) {
    for (int i = 0; i < config_.lanes; ++i) {
      const int x = record.x + i, y = record.y + j;
      if (x < 0 || y < 0 || x >= tile_.width || y >= tile_.height) continue;
      const auto lane = static_cast<std::size_t>(j * config_.lanes + i);
      cmodel::SheetWord& word = sums(x, y);
      accumulated(word, weights_[lane]);
      std::copy_n(record.payload.begin() + static_cast<std::ptrdiff_t>(4 * lane), 4, word.begin());
    }
  }
}

void SplatCoverage::accumulated(cmodel::SheetWord& before, std::uint32_t weight) {
  const std::int64_t largest = config_.sheet_format().max;
  int cut = 0;
  std::size_t last = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::int64_t product = product_[c].sample(coverage_, std::int64_t{record_.colour[c]} * weight).word;
    const std::int64_t sum = before[c] + product;
    if (sum == largest && product > 0) coverage_.hit(sum_exactly_ + c);
    if (!sites_[cmodel::Site::Sum](sum).overflow) continue;
    if (before[c] == largest) coverage_.hit(sum_stays_ + c);
    coverage_.hit(sum_saturated_ + c);
    ++cut;
    last = c;
  }
  if (cut == 1) coverage_.hit(sum_alone_ + last);
  if (cut == 4) coverage_.hit(sum_all_);
}

}  // namespace fastsplat::testbench
