// SPDX-License-Identifier: Apache-2.0
// One splat's additions to each of its sheets: values and places, gathered for add_footprint.
#pragma once

#include <vector>

#include "golden/add_footprint.hpp"
#include "golden/sheet.hpp"

namespace fastsplat::golden {

/// Reused from splat to splat to avoid allocations. Does not touch() the sheets: callers do so once for many splats.
class SplatSums {
 public:
  void clear() { values_.clear(), rows_.clear(); }
  /// All sheets have the same rows and width.
  void add(Sheet& sheet, int first_row, const Sums& value) {
    values_.push_back(value);
    rows_.push_back(sheet.row(first_row));
    first_row_ = first_row;
    pitch_ = sheet.pitch();
  }
  void add_footprint(const Footprint& footprint) const {
    golden::add_footprint(footprint, first_row_, pitch_, values_, rows_);
  }

 private:
  std::vector<Sums> values_;
  std::vector<Sums*> rows_;
  int first_row_ = 0;
  std::size_t pitch_ = 0;
};

}  // namespace fastsplat::golden
