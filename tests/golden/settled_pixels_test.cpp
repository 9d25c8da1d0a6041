// SPDX-License-Identifier: Apache-2.0
// Settled pixels: splats behind them do not change the stored value, and splats that reach only settled pixels are
// found.
#include "golden/settled_pixels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using Stored = std::array<float, 4>;

Stored stored(const FrontToBack& pixel) {
  Stored rgba{};
  pixel.store(rgba.data());
  return rgba;
}

// Any background: nothing, one opaque layer of the brightest or the darkest colour, thousands of thin ones.
TEST(SettledPixels, SplatsBehindDoNotChangeStoredPixels) {
  std::mt19937 random(9);
  const auto uniform = [&random](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  int settled_ones = 0, open_ones = 0, changed = 0;
  for (int i = 0; i < 20000; ++i) {
    FrontToBack pixel{uniform(0, 1), uniform(0, 1) * 0x1p-6, uniform(0, 1), std::exp2(-uniform(20, 60))};
    // Close to a rounding boundary of float, from either side.
    if (i % 3 == 0) {
      const float low = static_cast<float>(pixel.red), high = std::nextafter(low, 2.0f);
      pixel.red = 0.5 * (static_cast<double>(low) + high) - uniform(-1, 3) * pixel.transmittance;
    }
    if (i % 50 == 0) pixel.transmittance = 0.0;
    const Stored now = stored(pixel);
    bool same = true;
    const auto behind = [&](const auto& layers) {
      FrontToBack later = pixel;
      layers(later);
      same = same && stored(later) == now;
    };
    behind([](FrontToBack& p) { p.add({1.0, 1.0, 1.0, 1.0}); });
    behind([](FrontToBack& p) { p.add({0.0, 0.0, 0.0, 1.0}); });
    behind([&](FrontToBack& p) {
      for (int layer = 0; layer < 40; ++layer) {
        const double alpha = uniform(0, 1);
        p.add({alpha * uniform(0, 1), alpha, 0.0, alpha});
      }
    });
    if (i % 100 == 0) {
      behind([](FrontToBack& p) {
        for (int layer = 0; layer < 20000; ++layer)
          p.add(make_layer({1e-3, 1e-3, 0.5e-3, 1e-3}, scene::SlabOpacity::Exponential));
      });
    }
    if (settled(pixel)) {
      ++settled_ones;
      ASSERT_TRUE(same) << i << ": " << pixel.red << ' ' << pixel.transmittance;
    } else {
      ++open_ones;
    }
    changed += !same;
  }
  figure("settled_pixels_that_stay", settled_ones, "more than 3000, every one");
  figure("pixels_that_something_behind_changes", changed, "more than 3000, none of them settled");
  EXPECT_GT(settled_ones, 3000);
  EXPECT_GT(changed, 3000);
  EXPECT_LT(changed, open_ones + 1);
}

TEST(SettledPixels, OpenPixelsAreNotSettled) {
  EXPECT_FALSE(settled({0.5, 0.5, 0.5, 1.0}));
  EXPECT_FALSE(settled({0.5, 0.5, 0.5, 0x1p-25}));  // 1 - T is not yet 1 as a float
  EXPECT_FALSE(settled({0.5, 0.0, 0.5, 1e-20}));    // a channel without any light shows the faintest
  EXPECT_TRUE(settled({0.5, 0.0, 0.5, 0.0}));
  EXPECT_TRUE(settled({0.51, 0.3, 0.7, 1e-12}));
  EXPECT_FALSE(settled({0.5, 0.5, 0.5, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(SettledPixels, BrighterThanOpaqueIsRefused) {
  const scene::Splat fine{.position = {}, .emission = {1.0f, 0.0f, 0.5f}, .extinction = 1.0f, .sheet = 0};
  EXPECT_TRUE(never_brighter_than_opaque({}));
  EXPECT_TRUE(never_brighter_than_opaque({fine}));
  for (int c = 0; c < 3; ++c) {
    for (const float wrong : {1.0000001f, -1e-30f, std::numeric_limits<float>::quiet_NaN()}) {
      scene::Splat splat = fine;
      splat.emission[c] = wrong;
      EXPECT_FALSE(never_brighter_than_opaque({fine, splat})) << c << ' ' << wrong;
    }
  }
  scene::Splat endless = fine;
  endless.extinction = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(never_brighter_than_opaque({endless}));
}

/// Rows that a footprint can be seen in, found pixel by pixel.
TEST(SettledPixels, ASplatIsHiddenWhereEveryPixelOfItIs) {
  std::mt19937 random(21);
  const auto uniform = [&random](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  const scene::Kernel kernel(2.0, 2.0);
  int hidden = 0, cut = 0, whole = 0;
  for (const int width : {1, 63, 64, 65, 200}) {
    const Rows rows{16, 32};
    for (int trial = 0; trial < 400; ++trial) {
      SettledPixels pixels(rows, width);
      const double share = trial % 4 == 0 ? 1.0 : uniform(0.5, 1.0);
      std::vector<bool> is_settled(static_cast<std::size_t>(width) * 16);
      const int first_open = trial % 3 == 0 ? static_cast<int>(random() % 16) : 16;  // rows above it settled as a whole
      for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < width; ++x) {
          if (y >= first_open || uniform(0, 1) > share) continue;
          pixels.settle(x, rows.first + y);
          is_settled[static_cast<std::size_t>(y * width + x)] = true;
        }
      }
      ProjectedSplat splat;
      const double scale = uniform(0.3, 4.0);
      splat.x = uniform(-4, width + 4), splat.y = uniform(12, 36);
      splat.shape = {scale * scale, uniform(-0.5, 0.5) * scale * scale, uniform(0.5, 2.0) * scale * scale};
      splat.reach_x = kernel.radius() * std::sqrt(splat.shape.xx);
      splat.reach_y = kernel.radius() * std::sqrt(splat.shape.yy);
      const Rows open = pixels.open_rows(splat, rows);
      Footprint footprint;
      footprint.rasterise(kernel, splat, rows, width);
      int rows_kept = 0;
      for (const Footprint::Span& span : footprint.spans()) {
        bool seen = false;
        for (int x = span.x; x < span.x + span.width; ++x) {
          ASSERT_EQ(pixels.at(x, span.y), is_settled[static_cast<std::size_t>((span.y - rows.first) * width + x)]);
          seen = seen || !pixels.at(x, span.y);
        }
        const bool kept = span.y >= open.first && span.y < open.end;
        ASSERT_TRUE(kept || !seen) << "a row that can be seen was left out";
        rows_kept += kept;
      }
      hidden += !footprint.spans().empty() && rows_kept == 0;
      cut += rows_kept > 0 && rows_kept < static_cast<int>(footprint.spans().size());
      whole += rows_kept > 0 && rows_kept == static_cast<int>(footprint.spans().size());
    }
  }
  figure("splats_hidden", hidden, "more than 100");
  figure("splats_cut", cut, "more than 100");
  figure("splats_drawn_whole", whole, "more than 100");
  EXPECT_GT(hidden, 100);
  EXPECT_GT(cut, 100);
  EXPECT_GT(whole, 100);
}

TEST(SettledPixels, RunsEndWherePixelsChange) {
  int compared = 0;
  for (const int width : {1, 64, 130}) {
    SettledPixels pixels({0, 1}, width);
    std::vector<bool> is_settled(static_cast<std::size_t>(width));
    std::mt19937 random(3);
    for (int x = 0; x < width; ++x) {
      if (random() % 8 < 5 || (x > 70 && x < 129)) pixels.settle(x, 0), is_settled[static_cast<std::size_t>(x)] = true;
    }
    for (int begin = 0; begin <= width; ++begin) {
      for (int end = begin; end <= width; ++end) {
        int open = begin, closed = begin;
        while (open < end && is_settled[static_cast<std::size_t>(open)]) ++open;
        while (closed < end && !is_settled[static_cast<std::size_t>(closed)]) ++closed;
        ASSERT_EQ(pixels.next_open(begin, end, 0), open);
        ASSERT_EQ(pixels.next_settled(begin, end, 0), closed);
        ++compared;
      }
    }
  }
  figure("runs_compared", compared, "more than 1000");
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace fastsplat::golden::testing
