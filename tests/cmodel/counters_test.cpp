// SPDX-License-Identifier: Apache-2.0
// A frame small enough to count by hand.
#include <gtest/gtest.h>

#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

/// P = 2, k = 2, one set of rho 2. So E = Ea = 2, and a splat has one window of 2 x 2 pixels. A whole centre lies in
/// the window's first pixel: x0 = floor((2x - 2) / 2) + 1 = x. All RLUT words 0: every weight is RADIAL[0] = 127/64.
oracle::Symbols by_hand() {
  oracle::Symbols c;
  c.P = 2, c.W = 4, c.H = 4;
  c.pi = 4, c.pf = 1, c.k = 2;
  c.sets = 1, c.columns = 2, c.g = 0;
  c.N = 2, c.wi = 1, c.wf = 6;
  c.cf = 6, c.zf = 0, c.hf = 2;
  c.si = 1, c.sf = 4;
  c.G = 2, c.of = 4;
  c.tf = 4, c.eps = 1;
  c.xi = 0, c.xf = 4;
  return c;
}

TEST(Counters, OfATinyFrameAreThoseOfTheHand) {
  const oracle::Symbols c = by_hand();
  ASSERT_FALSE(cmodel::first_violation(config_of(c, "by_hand")));
  StreamWriter w(c);
  w.begin_frame(8, 4, 2);
  w.load_table(0, 0, 2, 0, {0, 0, 0, 0});
  w.load_table(1, 0, 0, 0, {127, 0});
  w.load_table(2, 0, 0, 0, {16, 16, 16});
  w.begin_tile(1, 0, 0, 0, 4, 3);
  w.begin_sheet(0);
  // 63/64 * 127/64 = 31.25/16, word 31: fits. tau the same.
  w.splat(0, 0, 0, {63, 0, 0, 63});  // pixels (0..1, 0..1), one block
  // Second time 31 + 31 leaves U1.4 in R and tau of 4 pixels: sheet_saturated 8.
  w.splat(0, 0, 0, {63, 0, 0, 63});
  w.cull_block(0, 0, 0, 4, 4, 1);
  // (3, 2): of 2 x 2 pixels only (3, 2) is inside the 4 x 3 tile. One block more.
  w.splat(0, 6, 4, {1, 1, 1, 1});
  // Wholly outside: a window without a lane inside.
  w.splat(0, -16, 0, {63, 63, 63, 63});
  w.end_sheet();  // blocks (0,0): 4 pixels, (2,2): rows 2 only, 2 pixels. R and tau at 4 pixels are 31/16: 8 cut to 1.0
  w.begin_sheet(1);
  w.splat(0, 0, 0, {0, 0, 0, 1});  // T is 0 < eps at those 4 pixels: 4 frozen
  w.end_sheet();
  w.end_tile();  // R = 16/16 and A = 16/16 at 4 pixels leave U0.4: 8 cut
  w.begin_tile(2, 1, 4, 0, 1, 1);
  for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {
    w.begin_sheet(sheet);
    w.splat(0, 0, 0, {63, 0, 0, 0});  // 1 of 4 pixels inside
    w.end_sheet();
  }
  w.end_tile();  // X_R: 31 + 31 is cut once (composite_saturated); the word 31 of U1.4 leaves U0.4: 1 pixel word cut
  w.end_frame();

  const std::map<std::string, std::uint64_t> expected{
      {"tiles", 2},  // N-9-9
      {"sheets", 4},
      {"splats", 7},
      {"windows", 7},        // N-9-8
      {"lanes_inside", 15},  // 4 + 4 + 1 + 0, 4, 1 + 1
      {"lanes_weighted", 15},
      {"cull_blocks", 1},
      {"dirty_blocks", 5},         // 2 + 1 and 1 + 1 (N-9-12)
      {"pixels_composited", 12},   // (4 + 2) + 4 and 1 + 1
      {"frozen_pixels", 4},        // N-9-14
      {"sheet_saturated", 8},      // N-9-11
      {"opacity_saturated", 8},    // N-9-13
      {"composite_saturated", 1},  // N-9-15
      {"pixel_saturated", 9},
  };
  const auto counts = run_model(config_of(c, "by_hand"), w.bytes()).counts;
  EXPECT_EQ(counts, expected);
  EXPECT_EQ(oracle::render(c, w.bytes()).counts, expected);
}

TEST(Counters, SaturatedProductsAndCentres) {
  oracle::Symbols c = by_hand();
  c.cf = 8, c.pf = 2;  // centres a quarter pixel fine: the last one rounds up, out of S4.1
  StreamWriter w(c);
  w.begin_frame(4, 4, 1);
  w.load_table(0, 0, 2, 0, {0, 0, 0, 0});
  w.load_table(1, 0, 0, 0, {127, 0});
  w.load_table(2, 0, 0, 0, {16, 16, 16});
  w.begin_tile(0, 0, 0, 0, 4, 4);
  w.begin_sheet(0);
  w.splat(0, 0, 0, {255, 254, 0, 255});  // 255/256 * 127/64 = 31.63/16 rounds to 32: cut, in 2 channels of 4 pixels
  w.splat(0, 31, 31, {0, 0, 0, 0});      // both axes
  w.end_sheet();
  w.end_tile();
  w.end_frame();
  const auto counts = run_model(config_of(c, "by_hand"), w.bytes()).counts;
  EXPECT_EQ(counts.at("snap_saturated"), 2U);  // N-9-10
  // 254/256 * 127/64 = 31.50/16: a tie, half up, so G is cut as well (N-9-11).
  EXPECT_EQ(counts.at("product_saturated"), 12U);
}

}  // namespace
}  // namespace fastsplat::test
