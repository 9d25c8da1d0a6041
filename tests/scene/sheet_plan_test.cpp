// SPDX-License-Identifier: Apache-2.0
// The one plan of sheets: the sheets of a splat, their number, and their places.
#include "scene/sheet_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "scene/kernel_growth.hpp"
#include "scene/splats.hpp"

namespace fastsplat::scene {
namespace {

SceneDescription small() {
  SceneDescription description;
  description.volume = "shells:12";
  description.width = description.height = 64;
  return description;
}

TEST(SheetPlan, EveryMethodHasItsUse) {
  SceneDescription description = small();
  const Scene scene = build_scene(description);
  description.xray_sheets = 7;
  const Scene sliced = build_scene(description);
  EXPECT_EQ(sheet_plan(scene, Method::ImageAligned).use, SheetUse::Sliced);
  EXPECT_EQ(sheet_plan(scene, Method::AxisAligned).use, SheetUse::GridSheet);
  EXPECT_EQ(sheet_plan(scene, Method::XRay).use, SheetUse::OneSheet);
  EXPECT_EQ(sheet_plan(sliced, Method::XRay).use, SheetUse::Sliced);
  for (const Method method : {Method::Westover, Method::RayCast}) {
    EXPECT_EQ(sheet_plan(scene, method).use, SheetUse::None);
    EXPECT_EQ(sheet_plan(scene, method).slabs.count, 0);
  }
}

TEST(SheetPlan, AxisAlignedSheetsHoldEverySplat) {
  const Scene scene = build_scene(small());
  const int count = sheet_plan(scene, Method::AxisAligned).slabs.count;
  EXPECT_EQ(count, 12);
  int splats = 0;
  for_each_splat(scene, [&](const Splat& splat) {
    EXPECT_LT(splat.sheet, count);
    ++splats;
  });
  std::printf("[figure] splats = %d (limit > 0)\n", splats);
  ASSERT_GT(splats, 0);
}

// N-8-62.
TEST(SheetPlan, XRaySheetsShareTheSlabsDepthRange) {
  SceneDescription description = small();
  const SlabGrid slabs = slab_grid(build_scene(description));
  for (const int sheets : {1, 2, 7, 300}) {
    description.xray_sheets = sheets;
    const SlabGrid grid = sheet_plan(build_scene(description), Method::XRay).slabs;
    EXPECT_EQ(grid.count, sheets);
    EXPECT_EQ(grid.first, slabs.first);
    EXPECT_NEAR(grid.count * grid.width, slabs.count * slabs.width, 1e-12 * slabs.count);
  }
}

/// N-8-55: grown kernels reach past the plain slabs: whole slabs come in front and behind, and the plain ones stay in
/// place.
TEST(SheetPlan, GrownKernelsFindSlabsAndThePlainOnesStay) {
  SceneDescription description = small();
  description.camera.zoom = 0.1;
  description.slab_width = 0.5;
  const SlabGrid plain = sheet_plan(build_scene(description)).slabs;
  description.footprint.antialias = true;
  const Scene scene = build_scene(description);
  const SlabGrid grown = sheet_plan(scene).slabs;
  EXPECT_EQ(grown.width, plain.width);
  EXPECT_GT(grown.count, plain.count);
  const double before = (plain.first - grown.first) / plain.width;
  EXPECT_EQ(before, std::floor(before));
  int reached = 0;
  for_each_splat(scene, [&](const Splat& splat) {
    const double mm = scene.camera.project(splat.position).depth, depth = mm / scene.volume->kernel_unit();
    const double reach = scene.kernel.radius() * depth_growth(scene, mm);
    EXPECT_GE(depth - reach, grown.first);
    EXPECT_LE(depth + reach, grown.first + grown.count * grown.width);
    ++reached;
  });
  std::printf("[figure] slabs = %d, of them for grown kernels = %d (limit > 0), splats = %d\n", grown.count,
              grown.count - plain.count, reached);
  ASSERT_GT(reached, 0);

  description.camera.zoom = 1e-5;
  EXPECT_THROW(sheet_plan(build_scene(description)), UserError);  // N-8-56
}

}  // namespace
}  // namespace fastsplat::scene
