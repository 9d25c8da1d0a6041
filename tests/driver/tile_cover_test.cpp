// SPDX-License-Identifier: Apache-2.0
// The area under rectangles, against every pixel counted.
#include "driver/files/tile_cover.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>

namespace fastsplat::driver {
namespace {

TEST(TileCover, NothingCoversNothing) {
  TileCover cover;
  EXPECT_EQ(cover.pixels(), 0);
  cover.add(3, 4, 0, 7);
  EXPECT_EQ(cover.pixels(), 0);
}

TEST(TileCover, AreasOfAnySizeAreCountedOnce) {
  TileCover cover;
  constexpr std::int64_t side = 65535;
  cover.add(0, 0, side, side);
  cover.add(5, 5, 10, 10);
  EXPECT_EQ(cover.pixels(), side * side);
}

TEST(TileCover, EqualsACountOfPixels) {
  std::uint32_t state = 1;
  const auto draw = [&](std::uint32_t below) {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::int64_t>((state >> 8) % below);
  };
  int rectangles = 0;
  for (int run = 0; run < 400; ++run) {
    TileCover cover;
    std::set<std::pair<std::int64_t, std::int64_t>> pixels;
    const auto count = 1 + draw(12);
    for (std::int64_t i = 0; i < count; ++i, ++rectangles) {
      const auto x = draw(20), y = draw(20), width = draw(9), height = draw(9);
      cover.add(x, y, width, height);
      for (auto v = y; v < y + height; ++v)
        for (auto u = x; u < x + width; ++u) pixels.insert({u, v});
    }
    ASSERT_EQ(cover.pixels(), static_cast<std::int64_t>(pixels.size())) << "run " << run;
  }
  std::printf("[figure] rectangles compared = %d\n", rectangles);
}

}  // namespace
}  // namespace fastsplat::driver
