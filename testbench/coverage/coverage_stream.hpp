// SPDX-License-Identifier: Apache-2.0
// Coverage of the contents of a stream: record kinds, tables, tiles, sheets, culling, colours (docs/stream.md).
#pragma once

#include <array>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/coverage/coverage.hpp"

namespace fastsplat::testbench {

class StreamCoverage {
 public:
  StreamCoverage(const cmodel::Config& config, Coverage& coverage);

  /// A record of a legal stream; load_table with all its words.
  void on_record(const cmodel::Record& record);

 private:
  using Id = Coverage::Id;
  void table(const cmodel::LoadTable& table);
  void tile(const cmodel::BeginTile& tile);
  void sheet(const cmodel::BeginSheet& sheet);
  void splat(const cmodel::SplatRecord& splat);
  void shape(const std::array<std::uint32_t, 4>& colour);  ///< a circle or an ellipse
  void end_sheet(const cmodel::EndSheet& end);

  cmodel::Config config_;
  Coverage& coverage_;
  Id record_ = 0;
  /// By cmodel::Table and cmodel::Mode, those of the configuration.
  std::array<Id, static_cast<std::size_t>(cmodel::Table::Pattern) + 1> table_kind_{};
  std::array<Id, static_cast<std::size_t>(cmodel::Mode::DensityAdditive) + 1> mode_{};
  Id loaded_again_ = 0, overlap_ = 0, first_columns_ = 0, last_columns_ = 0;
  Id full_width_ = 0, full_height_ = 0, partial_width_ = 0, partial_height_ = 0, one_pixel_ = 0;
  Id no_sheet_ = 0, next_tile_ = 0;
  Id empty_sheet_ = 0, one_splat_ = 0, number_gap_ = 0, number_zero_ = 0;
  Id cull_first_ = 0, cull_between_ = 0, cull_last_ = 0;
  Id first_set_ = 0, last_set_ = 0, other_set_ = 0;
  Id colour_zero_ = 0, colour_largest_ = 0;

  /// Tiles and sheets of densities.
  Id left_ = 0, right_ = 0, top_ = 0, bottom_ = 0, within_ = 0, neighbours_ = 0, missing_ = 0, alone_ = 0;

  std::vector<cmodel::RadiusSet> sets_;  ///< loaded ones; rho 0: none
  std::vector<std::uint32_t> extents_;
  std::uint64_t tiles_ = 0, sheets_ = 0, splats_ = 0;
  std::uint32_t number_ = 0, set_ = 0;
  std::int64_t frame_width_ = 0, frame_height_ = 0;
  bool densities_ = false;
  bool cull_pending_ = false, circle_ = false;  ///< in this sheet
};

}  // namespace fastsplat::testbench
