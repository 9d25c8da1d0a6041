// SPDX-License-Identifier: Apache-2.0
// Coverage of ellipses: shapes, windows and ranges of q (docs/numerics.md, section 4.6).
#pragma once

#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/coverage/coverage.hpp"
#include "testbench/coverage/coverage_interpolation.hpp"

namespace fastsplat::testbench {

class EllipseCoverage {
 public:
  EllipseCoverage(const cmodel::Config& config, Coverage& coverage);
  void record(const cmodel::EllipseRecord& record, bool behind_a_circle);
  void circle_follows() { coverage_.hit(before_circle_); }
  /// The window at pixel (column, row) of the record; `interpolation`: null for a device without it.
  void window(std::uint32_t column, std::uint32_t row, InterpolationCoverage* interpolation);

 private:
  using Id = Coverage::Id;
  cmodel::Config config_;
  Coverage& coverage_;
  cmodel::EllipseUnit unit_;
  cmodel::EllipseCoefficients f_;
  Id before_circle_ = 0, after_circle_ = 0, one_window_ = 0, columns_ = 0, rows_ = 0, both_ = 0;
  Id circle_ = 0, leans_right_ = 0, leans_left_ = 0, thinnest_ = 0;
  Id shift_right_ = 0, tie_ = 0;
  Id first_ = 0, last_ = 0, beyond_ = 0, far_ = 0, negative_ = 0;
};

}  // namespace fastsplat::testbench
