// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_ellipse.hpp"

namespace fastsplat::testbench {

EllipseCoverage::EllipseCoverage(const cmodel::Config& config, Coverage& coverage)
    : config_(config), coverage_(coverage), unit_(config) {
  const auto bin = [&](const char* name) { return coverage.declare("ellipse", name); };
  before_circle_ = bin("before_a_circle");
  after_circle_ = bin("behind_a_circle");
  one_window_ = bin("one_window");
  columns_ = bin("one_row_of_windows");
  rows_ = bin("one_column_of_windows");
  both_ = bin("rows_and_columns_of_windows");
  circle_ = bin("circle");
  leans_right_ = bin("leans_right");
  leans_left_ = bin("leans_left");
  thinnest_ = bin("thinnest");
  shift_right_ = bin("coefficients_lose_bits");
  tie_ = bin("coefficient_on_a_tie");
  first_ = bin("first_entry");
  last_ = bin("last_entry");
  beyond_ = bin("beyond_rim");
  far_ = bin("beyond_16_rims");
  negative_ = bin("q_below_zero");
}

void EllipseCoverage::record(const cmodel::EllipseRecord& record, bool behind_a_circle) {
  const cmodel::EllipseShape& shape = record.shape;
  const auto x = cmodel::ellipse_axis(config_, record.x, record.windows.left);
  const auto y = cmodel::ellipse_axis(config_, record.y, record.windows.top);
  f_ = unit_.coefficients(shape, x.distance, y.distance);
  const bool wide = record.windows.columns > 1, high = record.windows.rows > 1;
  coverage_.hit(wide ? (high ? both_ : columns_) : (high ? rows_ : one_window_));
  if (behind_a_circle) coverage_.hit(after_circle_);
  if (shape.a == shape.c && shape.b == 0) coverage_.hit(circle_);
  if (shape.b != 0) coverage_.hit(shape.b < 0 ? leans_right_ : leans_left_);
  const std::int64_t next = (shape.b < 0 ? -std::int64_t{shape.b} : std::int64_t{shape.b}) + 1;
  if (next * next > 4 * std::int64_t{shape.a} * shape.c && shape.b != 0) coverage_.hit(thinnest_);
  const int dropped = static_cast<int>(shape.shift) - config_.ellipse_frac_bits;
  if (dropped <= 0) return;
  coverage_.hit(shift_right_);
  const std::int64_t exact = cmodel::exact_q(shape, x.distance, y.distance);
  const std::int64_t rest = exact & ((std::int64_t{1} << dropped) - 1);
  if (rest == std::int64_t{1} << (dropped - 1)) coverage_.hit(tie_);
}

void EllipseCoverage::window(std::uint32_t column, std::uint32_t row, InterpolationCoverage* interpolation) {
  const auto lanes = static_cast<std::uint32_t>(config_.lanes);
  const auto entries = static_cast<std::uint64_t>(config_.radial_entries);
  for (std::uint32_t j = row; j < row + lanes; ++j) {
    for (std::uint32_t i = column; i < column + lanes; ++i) {
      const std::uint64_t index = unit_.index(f_, i, j);
      if (interpolation != nullptr) interpolation->weight(InterpolationCoverage::Ellipse, unit_.steps(f_, i, j));
      if (index == 0) coverage_.hit(unit_.q(f_, i, j) < 0 ? negative_ : first_);
      if (index + 1 == entries) coverage_.hit(last_);
      if (index >= entries) coverage_.hit(index >= 16 * entries ? far_ : beyond_);
    }
  }
}

}  // namespace fastsplat::testbench
