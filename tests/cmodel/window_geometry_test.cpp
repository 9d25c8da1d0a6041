// SPDX-License-Identifier: Apache-2.0
// The extents of a radius set (N-3-3) against pixels counted one by one.
#include "cmodel/numbers/window_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace fastsplat::cmodel {
namespace {

/// The most pixels strictly inside a support of radius rho, over all window phases m: pixel i of a window lies
/// (i+1) k - m - rho from the centre.
int most_inside(int k, int rho) {
  int most = 0;
  for (int m = 0; m < k; ++m) {
    int inside = 0;
    for (int i = 0; i <= 2 * rho; ++i) inside += std::abs((i + 1) * k - m - rho) < rho ? 1 : 0;
    most = std::max(most, inside);
  }
  return most;
}

TEST(WindowGeometry, HoldsEveryPixelOfTheSupportAndNoWindowMore) {
  Config config;
  int compared = 0;
  for (const int k : {1, 2, 8, 64}) {
    for (int rho = 1; rho <= 200; ++rho) {
      for (const int lanes : {1, 2, 4, 8}) {
        config.phases = k;
        config.lanes = lanes;
        const WindowGeometry geometry = window_geometry(config, static_cast<std::uint32_t>(rho));
        // Without sub-pixel positions both ends of 2 rho pixels lie on the rim, which is outside.
        EXPECT_EQ(static_cast<int>(geometry.extent), most_inside(k, rho) + (k == 1 ? 1 : 0)) << k << " " << rho;
        EXPECT_EQ(geometry.padded, geometry.windows * static_cast<std::uint32_t>(lanes));
        EXPECT_GE(geometry.padded, geometry.extent);
        EXPECT_LT(geometry.padded, geometry.extent + static_cast<std::uint32_t>(lanes));
        ++compared;
      }
    }
  }
  std::printf("[figure] radius sets = %d (limit > 0)\n", compared);
  ASSERT_GT(compared, 0);
}

/// A stream may hold any word for rho: doubled it leaves 32 bits.
TEST(WindowGeometry, TheLargestRadiusDoesNotWrap) {
  Config config;
  config.phases = 64;
  config.lanes = 8;
  EXPECT_EQ(window_geometry(config, 0xffffffffU).extent, 0x8000000U);
  EXPECT_EQ(window_geometry(config, 0xffffffffU).padded, 0x8000000U);
}

}  // namespace
}  // namespace fastsplat::cmodel
