// SPDX-License-Identifier: Apache-2.0
// X-ray: the total of one voxel in closed form, and independence of the number of sheets.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/sheet_plan.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

scene::Splat one_splat(const glm::vec3& position, float extinction) {
  return {position, glm::vec3(0.25f, 0.5f, 1.0f) * extinction, extinction, 0};
}

TEST(XRay, TotalOfOneVoxelIsItsExtinction) {
  for (const double scale : {1.0, 2.0, 4.0, 8.0}) {
    Lattice lattice;
    lattice.dims = glm::ivec3(4);
    lattice.pixels_per_mm = scale;
    const scene::Scene scene = make_scene(lattice);
    const double bound = sampling_bound(lattice.a, lattice.radius, scale);
    double worst = 0.0;
    for (const float phase : {0.0f, 0.1f, 0.25f, 0.4f, 0.5f}) {
      const Image image = xray(scene, {one_splat({phase / float(scale), 0.3f, -0.7f * phase}, 0.8f)}, {});
      const double total = channel_sum(image, 3) / (scale * scale);
      worst = std::max(worst, std::abs(total / 0.8 - 1.0));
      EXPECT_NEAR(channel_sum(image, 0), 0.25 * channel_sum(image, 3), 1e-5 * channel_sum(image, 3));
    }
    std::printf("bound %.3g: ", bound);
    figure("one_voxel_energy_error_at_" + std::to_string(static_cast<int>(scale)) + "px", worst,
           "sampling ripple and rim");
    EXPECT_LE(worst, bound);
  }
}

TEST(XRay, AnisotropicVoxelsWeighTheirCell) {
  // A voxel of a grid that is denser than the kernel unit stands for a smaller cell; the total is extinction times
  // cell.
  Lattice lattice;
  lattice.dims = {12, 8, 6};
  lattice.spacing = {0.5, 1.0, 2.0};
  lattice.azimuth = 25;
  lattice.elevation = 35;
  lattice.pixels_per_mm = 3.0;
  lattice.width = lattice.height = 96;
  const scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  ASSERT_EQ(splats.size(), 12u * 8u * 6u);
  double extinction = 0.0;
  for (const scene::Splat& splat : splats) extinction += splat.extinction;
  const double unit = 2.0;
  const double cell = 0.5 * 1.0 * 2.0 / (unit * unit * unit);
  const double pixels_per_unit = lattice.pixels_per_mm * unit;
  const double total = channel_sum(xray(scene, splats, {}), 3) / (pixels_per_unit * pixels_per_unit);
  const double error = std::abs(total / (extinction * cell) - 1.0);
  figure("anisotropic_energy_error", error, "sampling ripple and rim");
  EXPECT_LE(error, sampling_bound(lattice.a, lattice.radius, pixels_per_unit));
}

TEST(XRay, SheetsDoNotMatter) {
  Lattice lattice;
  lattice.azimuth = 31;
  lattice.elevation = 20;
  lattice.pixels_per_mm = 3.0;
  const scene::Scene one = make_scene(lattice);
  const std::vector<scene::Splat> splats = scene::collect_splats(one);
  const Image reference = xray(one, splats, {});
  const double largest = max_opacity(reference);
  ASSERT_GT(largest, 1.0);
  for (const int sheets : {2, 7, 64, 1000}) {
    lattice.xray_sheets = sheets;
    const double difference = max_difference(reference, xray(make_scene(lattice), splats, {})) / largest;
    figure("xray_" + std::to_string(sheets) + "_sheets_difference", difference, "limit 1.2e-7: one float rounding");
    EXPECT_LE(difference, std::ldexp(1.0, -23));
  }
}

// A long ring of wide sheets makes the bands narrower; this must not show either.
TEST(XRay, ManySheetsInAWideImage) {
  Lattice lattice;
  lattice.azimuth = 31;
  lattice.elevation = 20;
  lattice.width = 2048;
  lattice.height = 13;
  const scene::Scene one = make_scene(lattice);
  const std::vector<scene::Splat> splats = random_splats(one, 40, 3.0, 11);
  const Image reference = xray(one, splats, {});
  ASSERT_GT(max_opacity(reference), 0.1);
  lattice.xray_sheets = 3000;
  const double difference = max_difference(reference, xray(make_scene(lattice), splats, {})) / max_opacity(reference);
  figure("xray_3000_sheets_difference", difference, "limit 1.2e-7: one float rounding");
  EXPECT_LE(difference, std::ldexp(1.0, -23));
}

TEST(XRay, ExposureScalesEverything) {
  Lattice lattice;
  scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const Image once = xray(scene, splats, {});
  scene.xray_scale = 0.25;
  const Image quarter = xray(scene, splats, {});
  ASSERT_GT(max_opacity(once), 0.0);
  for (std::size_t i = 0; i < once.data.size(); ++i) ASSERT_EQ(once.data[i] * 0.25f, quarter.data[i]);
}

// The slabs cover the volume in any view; a splat outside them goes to the nearest slab.
TEST(XRay, SplatsInFrontOfAndBehindAllSlabsCount) {
  Lattice lattice;
  lattice.dims = glm::ivec3(4);
  lattice.xray_sheets = 5;
  const scene::Scene scene = make_scene(lattice);
  const scene::SlabGrid grid = scene::slab_grid(scene);
  for (const double depth : {-3.0, -1.0, -0.9, 0.9, 1.0, 3.0}) {  // in units of the slabs' extent from the centre
    const glm::dvec3 position = scene.camera.direction() * (depth * -grid.first);
    const std::vector<scene::Splat> splats = {one_splat(position, 0.5f)};
    const Image whole = westover(scene, splats, {});
    const Image rays = xray(scene, splats, {});
    const Image slabs = image_aligned(scene, splats, {});
    ASSERT_GT(max_opacity(whole), 0.2);
    for (std::size_t i = 3; i < whole.data.size(); i += 4) {
      ASSERT_NEAR(-std::expm1(-static_cast<double>(rays.data[i])), whole.data[i], std::ldexp(1.0, -23)) << depth;
      ASSERT_NEAR(slabs.data[i], whole.data[i], std::ldexp(1.0, -23)) << depth;
    }
  }
}

// A faint splat dims nothing: all techniques must show its line integral, up to the square of its optical depth.
TEST(XRay, FaintSplatLooksTheSameInEveryTechnique) {
  Lattice lattice;
  lattice.azimuth = 31;
  lattice.elevation = 20;
  const scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = {one_splat({0.3f, 1.7f, -2.2f}, 1e-3f)};
  const Image reference = xray(scene, splats, {});
  const double tau = max_opacity(reference);
  ASSERT_GT(tau, 1e-4);
  for (const auto method : {scene::Method::Westover, scene::Method::AxisAligned, scene::Method::ImageAligned}) {
    const double difference = max_difference(reference, render_splats(method, scene, splats)) / tau;
    figure(std::string("faint_splat_difference_") + scene::to_string(method), difference, "limit tau/2 = 3.2e-4");
    EXPECT_LE(difference, 0.5 * tau * (1 + 1e-3));
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
