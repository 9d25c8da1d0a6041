// SPDX-License-Identifier: Apache-2.0
// The pieces of occlusion culling against brute force: summed-area table, visibility tests, blocks of voxels.
#include "golden/occlusion_map.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "golden/splat/projection.hpp"
#include "golden/voxel_blocks.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using Random = std::mt19937;

int below(Random& random, int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }

void for_each_window(int width, int height, const std::function<void(const Window&)>& visit) {
  for (int top = 0; top < height; ++top) {
    for (int bottom = top + 1; bottom <= height; ++bottom) {
      for (int left = 0; left < width; ++left) {
        for (int right = left + 1; right <= width; ++right) visit({left, top, right, bottom});
      }
    }
  }
}

TEST(SummedAreaTable, FourCornersAreTheSumOfEveryWindow) {
  Random random(1);
  long windows = 0;
  for (int map = 0; map < 40; ++map) {
    const int width = 1 + below(random, 14), height = 1 + below(random, 14);
    SummedAreaTable table(width, height);
    std::vector<std::uint8_t> values(static_cast<std::size_t>(width) * height);
    for (int first_row = 0; first_row < height; first_row += 1 + below(random, 4)) {  // from the top, then parts
      for (std::size_t i = static_cast<std::size_t>(first_row) * width; i < values.size(); ++i) {
        values[i] = static_cast<std::uint8_t>(below(random, 256));
      }
      table.rebuild(values, first_row);
      for_each_window(width, height, [&](const Window& window) {
        std::uint32_t sum = 0;
        for (int y = window.top; y < window.bottom; ++y) {
          for (int x = window.left; x < window.right; ++x) sum += values[static_cast<std::size_t>(y) * width + x];
        }
        ASSERT_EQ(table.sum(window), sum);
        ++windows;
      });
    }
  }
  figure("windows_equal_to_brute_force", static_cast<double>(windows), "more than 100000");
  EXPECT_GT(windows, 100000);
}

// The corner of an image whose total is beyond 2^32: entries wrap around, sums of windows do not change.
TEST(SummedAreaTable, IsRightBeyondTheRangeOfItsEntries) {
  constexpr int kWidth = 8192, kHeight = 2080;
  constexpr double kTotal = 255.0 * kWidth * kHeight;
  SummedAreaTable table(kWidth, kHeight);
  table.rebuild(std::vector<std::uint8_t>(static_cast<std::size_t>(kWidth) * kHeight, 255), 0);
  figure("total_of_the_image", kTotal, "more than 2^32");
  ASSERT_GT(kTotal, 4294967296.0);
  const Window corner{kWidth - 100, kHeight - 50, kWidth, kHeight};
  EXPECT_EQ(table.sum(corner), 255u * 100 * 50);
}

/// A random map: mostly opaque, with holes.
std::vector<FrontToBack> random_picture(Random& random, int pixels) {
  std::vector<FrontToBack> picture(static_cast<std::size_t>(pixels));
  const int holes = below(random, 40);  // percent
  for (FrontToBack& pixel : picture) {
    pixel.transmittance = below(random, 100) < holes ? below(random, 1000) / 1000.0 : below(random, 1000) / 1e6;
  }
  return picture;
}

scene::Culling with(scene::VisibilityTest test, double freeze, double theta = 0.95) {
  return {.mode = scene::CullingMode::Splats, .test = test, .freeze = freeze, .theta = theta};
}

TEST(OcclusionMap, CountHidesExactlyTheWindowsThatAreOpaque) {
  Random random(2);
  constexpr double freeze = 0.01;
  long hidden = 0, seen = 0;
  for (int n = 0; n < 60; ++n) {
    const int width = 1 + below(random, 12), height = 1 + below(random, 12);
    OcclusionMap map(width, height, with(scene::VisibilityTest::Count, freeze));
    const auto picture = random_picture(random, width * height);
    map.update(picture, std::vector<golden::Run>(static_cast<std::size_t>(height), golden::Run{0, width}));
    for_each_window(width, height, [&](const Window& window) {
      bool opaque = true;
      for (int y = window.top; y < window.bottom; ++y) {
        for (int x = window.left; x < window.right; ++x) {
          opaque &= picture[static_cast<std::size_t>(y) * width + x].transmittance < freeze;
        }
      }
      ASSERT_EQ(map.hides(window), opaque);
      ++(opaque ? hidden : seen);
    });
  }
  figure("opaque_windows", static_cast<double>(hidden), "more than 5000, all hidden");
  figure("other_windows", static_cast<double>(seen), "more than 5000, none hidden");
  EXPECT_GT(hidden, 5000);
  EXPECT_GT(seen, 5000);
}

// One clear pixel among 16x16 opaque ones: the mean falls by 1/256 only.
TEST(OcclusionMap, AverageOverlooksAHoleWhichCountSees) {
  std::vector<FrontToBack> picture(16 * 16);
  for (FrontToBack& pixel : picture) pixel.transmittance = 0.0;
  picture[7 * 16 + 9].transmittance = 1.0;
  const std::vector<golden::Run> all(16, golden::Run{0, 16});
  OcclusionMap count(16, 16, with(scene::VisibilityTest::Count, 0.01));
  OcclusionMap average(16, 16, with(scene::VisibilityTest::Average, 0.01));
  count.update(picture, all);
  average.update(picture, all);
  EXPECT_FALSE(count.hides({0, 0, 16, 16}));
  EXPECT_TRUE(average.hides({0, 0, 16, 16}));
  figure("transmittance_that_average_hides", 1.0, "as much as there can be");
}

// The hidden part of Average adds up to area * (1 - theta) at most; a single pixel comes near that.
TEST(OcclusionMap, AverageKeepsItsBound) {
  Random random(3);
  long hidden = 0;
  double worst_share = 0.0;
  for (int n = 0; n < 100; ++n) {
    const double theta = 0.5 + below(random, 49) / 100.0;
    const int width = 1 + below(random, 10), height = 1 + below(random, 10);
    OcclusionMap map(width, height, with(scene::VisibilityTest::Average, 0.01, theta));
    const auto picture = random_picture(random, width * height);
    map.update(picture, std::vector<golden::Run>(static_cast<std::size_t>(height), golden::Run{0, width}));
    for_each_window(width, height, [&](const Window& window) {
      if (!map.hides(window)) return;
      double sum = 0.0, most = 0.0;
      for (int y = window.top; y < window.bottom; ++y) {
        for (int x = window.left; x < window.right; ++x) {
          const double transmittance = picture[static_cast<std::size_t>(y) * width + x].transmittance;
          sum += transmittance;
          most = std::max(most, transmittance);
        }
      }
      const double bound = static_cast<double>(window.area()) * (1.0 - theta);
      ASSERT_LE(sum, bound * (1.0 + 1e-12));
      worst_share = std::max(worst_share, most / std::min(1.0, bound));
      ++hidden;
    });
  }
  figure("windows_hidden_by_average", static_cast<double>(hidden), "more than 10000");
  figure("worst_pixel_over_its_bound", worst_share, "0.9..1");
  EXPECT_GT(hidden, 10000);
  EXPECT_GT(worst_share, 0.9);
}

std::vector<Lattice> block_scenes() {
  Lattice oblique;
  oblique.dims = {23, 14, 17};
  oblique.spacing = {1.0, 0.7, 1.3};
  oblique.azimuth = 33, oblique.elevation = -21, oblique.roll = 50;
  Lattice near = oblique;
  near.projection = scene::Projection::Perspective;
  near.fov = 45;
  near.pixels_per_mm = 6.0;  // some of it lies outside the picture
  near.slab_width = 0.4;
  return {oblique, near};
}

// A block may be called hidden only if all its voxels are: for any map, its window contains theirs, and its sheet is
// the first of theirs or an earlier one.
TEST(VoxelBlocks, ABlockThatIsHiddenHasNoVisibleVoxel) {
  constexpr int kMargin = 2;
  long voxels = 0, hidden_blocks = 0, hidden_voxels = 0, leaves = 0;
  for (const Lattice& lattice : block_scenes()) {
    const scene::Scene scene = make_scene(lattice);
    const Projector project(scene);
    const std::vector<scene::Splat> splats = random_splats(scene, 3000, 0.5, 7);
    const KernelSlices slices = image_slabs(scene);
    const WholeSplats whole(scene::axis_sheet_count(scene));
    const int width = scene.camera.width(), height = scene.camera.height();
    Random random(4);
    OcclusionMap map(width, height, with(scene::VisibilityTest::Count, 0.01));
    std::vector<FrontToBack> picture(static_cast<std::size_t>(width) * height);
    for (int y = 0; y < height; ++y) {  // opaque but for one quarter
      for (int x = 0; x < width; ++x) picture[y * width + x].transmittance = x < width / 2 && y < height / 2 ? 1 : 0;
    }
    map.update(picture, std::vector<golden::Run>(static_cast<std::size_t>(height), golden::Run{0, width}));

    const VoxelBlocks blocks(*scene.volume, splats, 4);
    std::vector<int> seen(splats.size());
    // Every splat under a block, which may be a leaf.
    const std::function<void(const VoxelBlock&, const std::function<void(std::uint32_t)>&)> visit =
        [&](const VoxelBlock& block, const std::function<void(std::uint32_t)>& take) {
          if (block.leaf) {
            for (const std::uint32_t i : blocks.splats(block)) take(i);
          } else {
            for (std::uint32_t c = 0; c < block.count; ++c) visit(blocks.blocks()[block.first + c], take);
          }
        };
    for (const VoxelBlock& block : blocks.blocks()) {
      leaves += block.leaf;
      const BlockView sliced = view_of(scene, slices, block, kMargin);
      const bool hidden = !sliced.window.empty() && map.hides(sliced.window);
      hidden_blocks += hidden;
      std::uint32_t below_it = 0;
      visit(block, [&](std::uint32_t i) {
        const ProjectedSplat splat = project(splats[i]);
        const Window window =
            window_around(splat.x, splat.y, splat.reach_x + kMargin, splat.reach_y + kMargin, width, height);
        ++below_it;
        seen[i] += block.leaf;
        ASSERT_LE(sliced.first_sheet, slices.first(splat));
        ASSERT_LE(view_of(scene, whole, block, kMargin).first_sheet, whole.first(splat));
        if (window.empty()) return;
        ASSERT_LE(sliced.window.left, window.left);
        ASSERT_LE(sliced.window.top, window.top);
        ASSERT_GE(sliced.window.right, window.right);
        ASSERT_GE(sliced.window.bottom, window.bottom);
        ASSERT_TRUE(!hidden || map.hides(window)) << i;
        hidden_voxels += hidden;
        ++voxels;
      });
      ASSERT_EQ(below_it, block.splats);
    }
    for (const int times : seen) ASSERT_EQ(times, 1);
    ASSERT_EQ(blocks.blocks().back().splats, splats.size());
  }
  figure("leaves", static_cast<double>(leaves), "each splat in one of them");
  figure("hidden_blocks", static_cast<double>(hidden_blocks), "more than 50");
  figure("voxels_in_hidden_blocks", static_cast<double>(hidden_voxels), "all hidden by their own test");
  EXPECT_GT(hidden_blocks, 50);
  EXPECT_GT(voxels, hidden_voxels);
}

}  // namespace
}  // namespace fastsplat::golden::testing
