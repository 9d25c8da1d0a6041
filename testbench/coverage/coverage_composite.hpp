// SPDX-License-Identifier: Apache-2.0
// Coverage of compositor and pixel out, from the model's Composite and Pixel taps: slab opacity, transmittance and
// early termination, saturation, blocks, output rounding (docs/numerics.md, sections 6 and 7).
#pragma once

#include <array>
#include <vector>

#include "cmodel/composite/composite_lane.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/sites.hpp"
#include "cmodel/stream/records.hpp"
#include "cmodel/stream/taps.hpp"
#include "testbench/coverage/coverage.hpp"
#include "testbench/coverage/coverage_splat.hpp"

namespace fastsplat::testbench {

class CompositeCoverage {
 public:
  /// Takes the sheet's sums from `splats` and empties them block by block.
  CompositeCoverage(const cmodel::Config& config, Coverage& coverage, SplatCoverage& splats);

  void load(const cmodel::LoadTable& table);
  void begin_tile(const cmodel::BeginTile& tile);
  void on_tap(const cmodel::TapRecord& record);

 private:
  using Id = Coverage::Id;
  using Four = std::array<RoundingPoint, 4>;
  Four four(const char* group, const std::string& prefix, cmodel::Site site, std::int64_t largest);
  void block(const cmodel::TapRecord& record);
  void window(const cmodel::TapRecord& record);
  void pixel_step(const cmodel::SheetWord& sums, const cmodel::PixelState& before, const cmodel::PixelState& after);
  std::array<std::int64_t, 4> slab(const cmodel::SheetWord& sums);
  void transmittance(std::uint32_t before, std::uint32_t after, bool light);
  void pixel(const cmodel::TapRecord& record);
  cmodel::PixelState blank() const;
  std::size_t block_of(int x, int y) const;

  cmodel::Config config_;
  Coverage& coverage_;
  SplatCoverage& splats_;
  std::size_t columns_;
  std::vector<std::uint32_t> factor_;
  cmodel::Sites sites_;
  cmodel::BeginTile tile_;
  std::vector<cmodel::PixelState> picture_;
  std::vector<bool> touched_;  ///< blocks of the tile

  Id segment_first_ = 0, segment_last_ = 0, tau_zero_ = 0, tau_largest_ = 0;
  RoundingPoint fall_;
  Four exponential_, additive_, light_, composited_out_, sum_out_;
  Id colour_saturated_ = 0, colour_alone_ = 0, sum_saturated_ = 0, sum_alone_ = 0;
  Id t_one_ = 0, t_zero_ = 0, at_threshold_ = 0, below_threshold_ = 0, crosses_ = 0, frozen_light_ = 0;
  Id block_first_ = 0, block_last_ = 0, block_blank_ = 0, block_again_ = 0, block_partial_ = 0;
  Id untouched_ = 0, alpha_zero_ = 0, alpha_one_ = 0;
};

}  // namespace fastsplat::testbench
