// SPDX-License-Identifier: Apache-2.0
// The lecture's table of early splat elimination: time without and with, and the share of voxels that is splatted.
// Processor time of one thread, which other work on the machine changes little.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>

#include "base/error.hpp"
#include "golden/render.hpp"
#include "scene/volume/volume_file.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::CullingMode;

struct Row {
  double without = 0.0, with = 0.0, traversal = 0.0;  ///< seconds
  CullingReport report;

  double gain() const { return without / with; }
};

/// Splatting only; the voxels are classified before. Drawn the plain way: the fast one omits splats behind frozen
/// pixels with or without culling, so it has no "without".
Image splat(const scene::Scene& scene, const std::vector<scene::Splat>& splats, CullingMode mode, double& seconds,
            CullingReport& culling) {
  scene::Scene as = scene;
  as.description.culling.mode = mode;
  RenderReport report;
  const std::clock_t start = std::clock();
  Image image = image_aligned(as, splats, {.threads = 1, .progress = {}, .report = &report, .plain = true});
  seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  culling = report.culling.value_or(CullingReport{});
  return image;
}

Row measure(const char* name, const std::string& volume, const char* transfer_function, double opacity_scale) {
  scene::SceneDescription description;
  description.volume = volume;
  description.transfer_function = transfer_function;
  description.opacity_scale = opacity_scale;
  description.culling.freeze = 1.0 / 1024.0;  // as the device's `base`: 64/65536
  const scene::Scene scene = scene::build_scene(description);
  const std::clock_t start = std::clock();
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  Row row;
  row.traversal = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  CullingReport none, singly;
  double by_splats = 0.0;
  const Image off = splat(scene, splats, CullingMode::Off, row.without, none);
  const Image tested = splat(scene, splats, CullingMode::Splats, by_splats, singly);
  const Image blocks = splat(scene, splats, CullingMode::Blocks, row.with, row.report);
  EXPECT_EQ(off, tested) << name;
  EXPECT_EQ(off, blocks) << name;
  const CullingReport& r = row.report;
  const auto percent = [&r](std::uint64_t part) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(r.voxels);
  };
  fmt::print(
      "| {} | {:.2f} s | {:.2f} s | {:.2f} s | {:.1f} | {:.1f} % | {:.1f} % | {:.1f} % | {} | {} | {:.3f} s | {:.3f} s "
      "| "
      "{:.2f} s |\n",
      name, row.without, by_splats, row.with, row.gain(), percent(r.splatted), percent(r.culled_in_blocks),
      percent(r.culled_singly), r.splat_tests, r.block_tests, r.test_seconds, r.map_seconds, row.traversal);
  std::fflush(stdout);
  return row;
}

TEST(CullingTable, InTheLecturesShape) {
  try {
    volume::load_volume("ch2bet");
  } catch (const UserError& error) {
    GTEST_SKIP() << "the scan is not installed: " << error.what();
  }
  std::printf(
      "| volume | without | with: splats | with: blocks | gain | splatted | culled in blocks | singly | splats tested "
      "| "
      "blocks tested | tests | map | classifying |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const Row head = measure("head", "ch2bet", "mri-head", 1.0);
  const Row transparent = measure("transparent head", "ch2bet", "mri-head", 0.1);
  const Row shells = measure("shells:128", "shells:128", "default", 1.0);
  const Row lobb = measure("marschner-lobb:96", "marschner-lobb:96", "default", 1.0);

  figure("head_gain", head.gain(), "more than 1.5");
  EXPECT_GT(head.gain(), 1.5);
  EXPECT_LT(head.report.share_splatted(), 0.25);
  for (const Row* row : {&transparent, &shells, &lobb}) {
    EXPECT_GT(row->report.share_splatted(), head.report.share_splatted()) << "the opaque head culls most";
    EXPECT_LT(row->gain(), head.gain());
  }
  // If time were proportional to splats, the gain would be 1 / share; the tests and other work bound it.
  figure("head_gain_if_time_went_as_splats", 1.0 / head.report.share_splatted(), "more than the gain");
  EXPECT_LT(head.gain(), 1.0 / head.report.share_splatted());
}

}  // namespace
}  // namespace fastsplat::golden::testing
