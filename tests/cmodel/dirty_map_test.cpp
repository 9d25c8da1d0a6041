// SPDX-License-Identifier: Apache-2.0
// Dirty blocks against a set of places: rows of several mark words, footprints across their ends and the tile's.
#include "cmodel/splat/dirty_map.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>
#include <utility>

#include "cmodel/splat/sheet_buffer.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::test {
namespace {

using Places = std::vector<std::pair<int, int>>;  ///< row, column

Places marked(const cmodel::DirtyMap& map) {
  Places out;
  map.each([&](int column, int row) { out.emplace_back(row, column); });
  return out;
}

// N-9-6, N-9-4
TEST(DirtyMap, HasEveryBlockThatAFootprintMeetsOnceAndInOrder) {
  Random random(seed_or(3));
  std::size_t blocks = 0, tiles = 0;
  for (; tiles < 60; ++tiles) {
    const int lanes = 1 << random.between(0, 3);
    const auto width = static_cast<int>(random.between(1, 200 * lanes)),
               height = static_cast<int>(random.between(1, 20 * lanes));
    cmodel::DirtyMap map(lanes);
    map.begin_tile(width, height);
    std::set<std::pair<int, int>> expected;
    for (std::int64_t marks = random.between(0, 3); marks > 0; --marks) {
      const auto side = static_cast<int>(random.between(1, 100 * lanes));
      const auto x = static_cast<int>(random.between(-side, width)),
                 y = static_cast<int>(random.between(-side, height));
      map.mark(x, y, side, side);
      for (int row = std::max(y, 0); row < std::min(y + side, height); ++row)
        for (int column = std::max(x, 0); column < std::min(x + side, width); ++column)
          expected.emplace(row / lanes, column / lanes);
    }
    // M-walk-1, and in the order of the walk (M-walk-3)
    EXPECT_EQ(marked(map), Places(expected.begin(), expected.end())) << width << " x " << height << ", lanes " << lanes;
    EXPECT_EQ(map.count(), expected.size());
    blocks += expected.size();
    map.clear();
    EXPECT_TRUE(marked(map).empty());
  }
  std::printf("[figure] tiles = %zu, dirty blocks = %zu (limit > 10000)\n", tiles, blocks);
  EXPECT_GT(blocks, 10000u);
}

TEST(SheetBuffer, SaysWhichPixelsAreTheTiles) {
  cmodel::SheetBuffer sheet(named_config("tiny"));
  sheet.begin_tile(5, 3);
  std::set<std::pair<int, int>> inside;
  for (int y = -2; y < 8; ++y)
    for (int x = -2; x < 8; ++x)
      if (sheet.inside(x, y)) inside.emplace(x, y);
  std::printf("[figure] pixels inside of 5 x 3 = %zu (limit 15)\n", inside.size());
  EXPECT_EQ(inside.size(), 15u);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_TRUE(inside.contains({x, y})) << x << ", " << y;
}

}  // namespace
}  // namespace fastsplat::test
