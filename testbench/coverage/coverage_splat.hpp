// SPDX-License-Identifier: Apache-2.0
// Coverage of the splat path, from the model's Snap, Footprint and Sheet taps: snapping, window places, RLUT and radial
// table, products and sheet sums (docs/numerics.md, sections 3 to 5).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/sites.hpp"
#include "cmodel/splat/rlut.hpp"
#include "cmodel/splat/sheet_buffer.hpp"
#include "cmodel/stream/records.hpp"
#include "cmodel/stream/taps.hpp"
#include "testbench/coverage/coverage.hpp"
#include "testbench/coverage/coverage_ellipse.hpp"
#include "testbench/coverage/coverage_interpolation.hpp"

namespace fastsplat::testbench {

class SplatCoverage {
 public:
  SplatCoverage(const cmodel::Config& config, Coverage& coverage);

  void load(const cmodel::LoadTable& table);
  void begin_tile(const cmodel::BeginTile& tile);
  /// The splat whose taps follow.
  void splat(const cmodel::SplatRecord& record);
  void ellipse(const cmodel::EllipseRecord& record);
  void on_tap(const cmodel::TapRecord& record);

  /// The sheet's sums at a pixel of the tile; the compositor's side empties them.
  cmodel::SheetWord& sums(int x, int y) {
    return sums_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
  }
  /// Every sample: the last Footprint tap's sample at pixel `lane` of its window; nothing if the pixel has no
  /// weight.
  std::optional<cmodel::SheetWord> sample(std::size_t lane);

 private:
  using Id = Coverage::Id;
  void snapped(const cmodel::TapRecord& record);
  void footprint(const cmodel::TapRecord& record);
  void accumulated(const cmodel::TapRecord& record);
  void accumulated(cmodel::SheetWord& before, std::uint32_t weight);
  void place(std::int32_t x, std::int32_t y);
  std::size_t axis_class(std::int32_t origin, int side) const;

  cmodel::Config config_;
  Coverage& coverage_;
  std::size_t columns_;  ///< tile width
  cmodel::Sites sites_;
  cmodel::Rlut rlut_;
  std::array<std::uint32_t, 256> base_{};  ///< first RLUT column of each set
  cmodel::BeginTile tile_;
  cmodel::SplatRecord record_;  ///< or an ellipse's colours
  std::optional<InterpolationCoverage> interpolation_;
  std::optional<EllipseCoverage> ellipses_;  ///< of a configuration with ellipses
  bool in_ellipse_ = false, after_circle_ = false;
  std::int32_t x0_ = 0, y0_ = 0;
  std::uint32_t mx_ = 0, my_ = 0;
  std::vector<std::uint32_t> weights_;
  std::vector<cmodel::SheetWord> sums_;

  RoundingPoint snap_x_, snap_y_;
  Id centre_ = 0, phase_x_ = 0, phase_y_ = 0, bank_ = 0, windows_per_side_ = 0;
  std::vector<Id> edges_;  ///< [y class][x class]
  Id rlut_zero_ = 0, rlut_rim_ = 0, rlut_first_ = 0, rlut_last_ = 0;
  Id index_first_ = 0, index_last_ = 0, index_last_inside_ = 0, index_at_rim_ = 0, index_beyond_ = 0,
     index_furthest_ = 0;
  Id weight_zero_ = 0, weight_largest_ = 0;
  std::array<RoundingPoint, 4> product_;
  Id sum_saturated_ = 0, sum_alone_ = 0, sum_all_ = 0, sum_exactly_ = 0, sum_stays_ = 0;
};

}  // namespace fastsplat::testbench
