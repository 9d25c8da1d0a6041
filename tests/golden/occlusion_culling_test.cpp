// SPDX-License-Identifier: Apache-2.0
// Occlusion culling on whole frames: no bit of the picture changes, more opacity culls more, and transparent scenes
// cull nothing.
#include "golden/occlusion_culling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::CullingMode;
using scene::VisibilityTest;

constexpr double kFreeze = 0.01;

Lattice opaque() {
  Lattice lattice;
  lattice.dims = {18, 14, 16};
  lattice.optical_depth = 3.0;
  lattice.azimuth = 25, lattice.elevation = 20;
  lattice.pixels_per_mm = 3.0;
  lattice.width = 90, lattice.height = 77;
  return lattice;
}

scene::Scene culled(const Lattice& lattice, CullingMode mode, double freeze = kFreeze, int block = 4) {
  scene::Scene scene = make_scene(lattice);
  scene.description.culling = {.mode = mode, .freeze = freeze, .block = block};
  return scene;
}

struct Frame {
  Image image;
  CullingReport report;
};

Frame render_frame(const scene::Scene& scene, const std::vector<scene::Splat>& splats, bool axis, int threads = 0) {
  RenderReport report;
  Frame frame;
  const RenderOptions options{.threads = threads, .progress = {}, .report = &report};
  frame.image = axis ? axis_aligned(scene, splats, options) : image_aligned(scene, splats, options);
  frame.report = report.culling.value_or(CullingReport{});
  return frame;
}

Frame render_frame(const scene::Scene& scene, bool axis = false, int threads = 0) {
  return render_frame(scene, scene::collect_splats(scene), axis, threads);
}

void expect_books_balance(const CullingReport& report) {
  EXPECT_EQ(report.voxels, report.outside + report.culled_in_blocks + report.culled_singly + report.splatted);
  EXPECT_EQ(report.splat_tests, report.culled_singly + report.splatted);
}

std::vector<Lattice> scenes() {
  Lattice thin = opaque();
  thin.slab_width = 0.4;
  Lattice thick = opaque();
  thick.slab_width = 3.0;
  thick.slab_opacity = scene::SlabOpacity::Additive;
  Lattice near = opaque();
  near.projection = scene::Projection::Perspective;
  near.fov = 40, near.roll = 30;
  near.pixels_per_mm = 5.0;  // some of it lies outside the picture
  Lattice anisotropic = opaque();
  anisotropic.spacing = {1.0, 0.6, 1.4};
  return {opaque(), thin, thick, near, anisotropic};
}

TEST(OcclusionCulling, NotABitOfThePictureChanges) {
  int compared = 0;
  std::uint64_t splats = 0, single = 0, in_blocks = 0;
  for (const Lattice& lattice : scenes()) {
    for (const bool axis : {false, true}) {
      const Frame off = render_frame(culled(lattice, CullingMode::Off), axis);
      ASSERT_GT(max_opacity(off.image), 1.0 - kFreeze);
      const scene::Scene by_splats = culled(lattice, CullingMode::Splats);
      const Frame singly = render_frame(by_splats, axis);
      EXPECT_EQ(off.image, singly.image);
      expect_books_balance(singly.report);
      ++compared;
      for (const int threads : {1, 3}) {
        for (const int block : {3, 8}) {
          const Frame blocks = render_frame(culled(lattice, CullingMode::Blocks, kFreeze, block), axis, threads);
          EXPECT_EQ(off.image, blocks.image);
          expect_books_balance(blocks.report);
          // A voxel of a hidden block would have failed its own test.
          EXPECT_EQ(blocks.report.splatted, singly.report.splatted);
          in_blocks += blocks.report.culled_in_blocks;
          splats += blocks.report.voxels;
          single += blocks.report.culled_singly;
          ++compared;
        }
      }
    }
  }
  figure("images_equal_bit_for_bit", compared, "more than 0");
  figure("share_culled_in_blocks", static_cast<double>(in_blocks) / static_cast<double>(splats), "more than 0.1");
  figure("share_culled_singly", static_cast<double>(single) / static_cast<double>(splats), "more than 0.1");
  EXPECT_GT(in_blocks, splats / 10);
  EXPECT_GT(single, splats / 10);
}

// The order in which doubles are added decides their last bits: both modes show the splats in the scene's order.
TEST(OcclusionCulling, BlocksDoNotChangeTheOrder) {
  const scene::Scene scene = culled(opaque(), CullingMode::Off);
  const std::vector<scene::Splat> splats = random_splats(scene, 4000, 1.0, 5);
  const KernelSlices slices = image_slabs(scene);
  OcclusionCulling singly(scene, splats, 0, slices, {.mode = CullingMode::Splats, .freeze = kFreeze});
  OcclusionCulling blocks(scene, splats, 0, slices, {.mode = CullingMode::Blocks, .freeze = kFreeze, .block = 4});
  std::size_t compared = 0;
  for (int sheet = 0; sheet < slices.sheets(); ++sheet) {
    const auto a = singly.visible(sheet, 0), b = blocks.visible(sheet, 0);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].value, b[i].value) << sheet << ' ' << i;
    compared += a.size();
  }
  figure("splats_in_the_same_place", static_cast<double>(compared), "all");
  EXPECT_EQ(compared, splats.size());
}

// Stages that read neighbouring pixels widen the area that must be opaque: a splat `margin` pixels from an open half is
// kept.
TEST(OcclusionCulling, AMarginKeepsTheSplatsBesideOpenPixels) {
  const scene::Scene scene = culled(opaque(), CullingMode::Splats);
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const KernelSlices slices = image_slabs(scene);
  const int width = scene.camera.width(), height = scene.camera.height(), open = width / 2;
  std::vector<FrontToBack> picture(static_cast<std::size_t>(width) * height);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    picture[i].transmittance = static_cast<int>(i % static_cast<std::size_t>(width)) < open ? 1.0 : 0.0;
  }
  std::size_t kept[2] = {};
  for (const int margin : {0, 3}) {
    OcclusionCulling culling(scene, splats, 0, slices, scene.description.culling);
    culling.composited(picture, std::vector<golden::Run>(static_cast<std::size_t>(height), golden::Run{0, width}));
    for (int sheet = 0; sheet < slices.sheets(); ++sheet) {
      for (const ProjectedSplat& splat : culling.visible(sheet, margin)) {
        ASSERT_LE(std::ceil(splat.x - splat.reach_x - margin), open - 1);
        ++kept[margin > 0];
      }
    }
  }
  figure("splats_kept", static_cast<double>(kept[0]), "fewer than with a margin");
  figure("splats_kept_with_margin_3", static_cast<double>(kept[1]), "more");
  EXPECT_GT(kept[1], kept[0]);
}

// Splats at random places, of random opacity: holes between them, and blocks that are not full.
TEST(OcclusionCulling, NorWithSplatsAtRandomPlaces) {
  Lattice lattice = opaque();
  std::uint64_t hidden = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto with = [&](CullingMode mode) {
      const scene::Scene scene = culled(lattice, mode);
      return render_frame(scene, random_splats(scene, 6000, 4.0, seed), seed % 2 == 0);
    };
    const Frame off = with(CullingMode::Off), singly = with(CullingMode::Splats), blocks = with(CullingMode::Blocks);
    EXPECT_EQ(off.image, singly.image);
    EXPECT_EQ(off.image, blocks.image);
    hidden += singly.report.culled_singly;
  }
  figure("splats_hidden", static_cast<double>(hidden), "more than 1000");
  EXPECT_GT(hidden, 1000u);
}

// Gradients that look at neighbouring pixels and sheets: the footprint is tested with that margin.
TEST(OcclusionCulling, NorWhenPixelsAreClassifiedAfterSplatting) {
  const auto with = [&](CullingMode mode) {
    scene::Scene scene = culled(opaque(), mode);
    scene.description.classify = scene::ClassifyOrder::Post;
    scene.shading.on = true;
    RenderReport report;
    Frame frame;
    frame.image = post_classified(scene, {.threads = 0, .progress = {}, .report = &report});
    frame.report = report.culling.value_or(CullingReport{});
    return frame;
  };
  const Frame off = with(CullingMode::Off), singly = with(CullingMode::Splats), blocks = with(CullingMode::Blocks);
  ASSERT_GT(max_opacity(off.image), 1.0 - kFreeze);
  EXPECT_EQ(off.image, singly.image);
  EXPECT_EQ(off.image, blocks.image);
  figure("share_splatted_post_classified", blocks.report.share_splatted(), "less than 0.9");
  EXPECT_LT(blocks.report.share_splatted(), 0.9);
}

// Footprints of other shapes: tested by their own extent.
TEST(OcclusionCulling, NorWithEllipsesInPerspective) {
  Lattice lattice = scenes()[3];
  const auto with = [&](CullingMode mode) {
    scene::Scene scene = culled(lattice, mode);
    scene.description.footprint = {.shape = scene::FootprintShape::Ellipse, .antialias = true};
    return render_frame(scene);
  };
  const Frame off = with(CullingMode::Off), singly = with(CullingMode::Splats);
  EXPECT_EQ(off.image, singly.image);
  figure("share_splatted_ellipses", singly.report.share_splatted(), "less than 0.9");
  EXPECT_LT(singly.report.share_splatted(), 0.9);
}

// Pixels that are not frozen still gather splats behind them: at most eps, since colours stay below 1.
TEST(OcclusionCulling, WithoutFreezingTheDifferenceIsBelowTheThreshold) {
  Lattice lattice = opaque();
  lattice.optical_depth = 0.6;  // thin enough that much is behind when a pixel passes the threshold
  const scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const KernelSlices slices = image_slabs(scene);
  const Image full = sweep_frame(scene, splats, {}, slices, {});
  int differing = 0;
  for (const double eps : {0.3, 0.1, 0.03, 0.01}) {
    OcclusionCulling culling(scene, splats, 0, slices, {.mode = CullingMode::Blocks, .freeze = eps, .block = 4});
    const Image image = sweep_frame(scene, splats, {}, slices, {.occlusion = &culling});
    const double difference = max_difference(full, image);
    char name[64];
    std::snprintf(name, sizeof name, "max_difference_without_freezing_%g", eps);
    figure(name, difference, "at most that");
    EXPECT_LE(difference, eps);
    differing += difference > 0.0;
  }
  EXPECT_EQ(differing, 4) << "nothing was lost, so nothing was tested";
}

TEST(OcclusionCulling, CullsMoreTheMoreIsOpaque) {
  const auto share = [](double optical_depth, double freeze) {
    Lattice lattice = opaque();
    lattice.optical_depth = optical_depth;
    return 1.0 - render_frame(culled(lattice, CullingMode::Blocks, freeze)).report.share_splatted();
  };
  double last = -1.0;
  for (const double freeze : {1e-6, 1e-4, 1e-2, 0.1, 0.3}) {
    const double now = share(1.0, freeze);
    figure("share_culled_at_freeze_" + std::to_string(freeze), now, "grows");
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_GT(last, share(1.0, 1e-6));
  last = -1.0;
  for (const double optical_depth : {0.02, 0.2, 0.6, 2.0, 6.0}) {
    const double now = share(optical_depth, kFreeze);
    figure("share_culled_at_depth_" + std::to_string(optical_depth), now, "grows");
    EXPECT_GE(now, last);
    EXPECT_TRUE(optical_depth > 0.02 || now == 0.0) << now;
    last = now;
  }
  EXPECT_GT(last, 0.3);
}

// The deck's mean opacity: it culls more than is correct, by an error that the remaining transmittance bounds.
TEST(OcclusionCulling, AverageIsNotExact) {
  scene::Scene scene = culled(opaque(), CullingMode::Splats);
  const Frame count = render_frame(scene);
  scene.description.culling.test = VisibilityTest::Average;
  scene.description.culling.theta = 0.8;
  const Frame average = render_frame(scene);
  const double difference = max_difference(count.image, average.image);
  figure("splatted_by_count", static_cast<double>(count.report.splatted), "more than by average");
  figure("splatted_by_average", static_cast<double>(average.report.splatted), "fewer than by count");
  figure("max_difference_of_average", difference, "more than a step of 8 bits, at most 1");
  EXPECT_LT(average.report.splatted, count.report.splatted);
  EXPECT_GT(difference, 1.0 / 255.0);
  EXPECT_LE(difference, 1.0);
}

TEST(OcclusionCulling, AnEmptySceneIsFine) {
  scene::Scene scene = make_empty_scene(opaque());
  scene.description.culling = {.mode = CullingMode::Blocks, .freeze = kFreeze};
  const Frame frame = render_frame(scene);
  EXPECT_EQ(max_opacity(frame.image), 0.0);
  EXPECT_EQ(frame.report.voxels, 0u);
  EXPECT_EQ(frame.report.share_splatted(), 0.0);
}

}  // namespace
}  // namespace fastsplat::golden::testing
