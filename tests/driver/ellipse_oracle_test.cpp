// SPDX-License-Identifier: Apache-2.0
// The driver against docs/numerics.md, section 8, "Ellipses": every beat of frames whose splats are shaped by the view,
// by growth, motion and lens, alone and together.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/config/config_file.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/driver/oracle_helper.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using D = scene::SceneDescription;

double real(test::Random& random, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(random.next() >> 11), -53);
}

enum Shaper {
  kView = 1,
  kGrowth = 2,
  kMotion = 4,
  kLens = 8,
  kAll = 15,
  kRow = 16
};  // kRow: motion exactly along a row

/// A few voxels, mostly off the picture's centre, from a tenth of a pixel to a hundred pixels a voxel.
scene::Scene random_scene(test::Random& random, const cmodel::Config& config, scene::Method method, int shapers) {
  while (true) {
    glm::ivec3 dims;
    for (int axis = 0; axis < 3; ++axis) dims[axis] = static_cast<int>(random.between(1, 5));
    std::vector<float> voxels;
    for (int i = 0; i < dims.x * dims.y * dims.z; ++i)
      voxels.push_back(random.once_in(3) ? static_cast<float>(real(random, 0.0, 1.0)) : 0.0F);
    voxels[0] = 1.0F;
    const auto volume = volume_of(dims, {real(random, 0.5, 2.0), 1.0, real(random, 0.5, 2.0)}, voxels);
    D description;
    description.method = method;
    if (method == scene::Method::XRay) description.xray_sheets = random.once_in(2) ? 1 : 5;
    description.transfer_function = random.once_in(2) ? "linear" : "two-colours";
    description.opacity_scale = random.once_in(3) ? 20.0 : 0.3;
    description.slab_width = real(random, 0.4, 2.0);
    description.width = static_cast<int>(random.between(1, config.tile_width + 40));
    description.height = static_cast<int>(random.between(1, config.tile_height + 40));
    description.camera.azimuth = real(random, -180.0, 180.0);
    description.camera.elevation = real(random, -90.0, 90.0);
    description.camera.roll = random.once_in(2) ? 0.0 : real(random, -180.0, 180.0);
    const bool along_x = (shapers & kRow) != 0;
    if (along_x) description.camera.azimuth = description.camera.elevation = description.camera.roll = 0.0;
    const bool lens = (shapers & kLens) != 0, view = (shapers & kView) != 0;
    if (view || lens || (!along_x && random.once_in(2))) description.camera.projection = scene::Projection::Perspective;
    description.camera.fov = real(random, 10.0, 90.0);
    if (view) description.footprint.shape = scene::FootprintShape::Ellipse;
    description.footprint.antialias = (shapers & kGrowth) != 0;
    if ((shapers & kMotion) != 0 && !along_x && random.once_in(2)) description.motion.orbit = real(random, -30.0, 30.0);
    if ((shapers & kMotion) != 0 && description.motion.orbit == 0.0)
      description.motion.translate = {real(random, -3.0, 3.0), along_x ? 0.0 : real(random, -3.0, 3.0),
                                      along_x ? 0.0 : real(random, -3.0, 3.0)};
    if (lens) {
      description.lens.depth_of_field = scene::DepthOfField::Splats;
      description.lens.aperture = real(random, 0.1, 3.0);
      description.lens.focus = real(random, -1.0, 1.0);
    }
    const double most = config.max_extent() / 2.0;
    const double wanted = along_x                                         ? real(random, 0.05, 0.2)
                          : (shapers & kGrowth) != 0 && random.once_in(2) ? real(random, 0.1, 2.0)
                          : random.once_in(4)                             ? real(random, 0.3, 1.1) * most
                          : random.once_in(4)                             ? real(random, 0.02, 0.3)
                                                                          : real(random, 0.1, std::min(9.0, most));
    try {
      const auto usual = scene::build_scene(description, volume);
      description.camera.zoom =
          std::clamp(wanted / (usual.kernel.radius() * volume->kernel_unit() * usual.camera.scale_at(0.0)), 1e-3, 1e3);
      return scene::build_scene(description, volume);
    } catch (const UserError&) {
      // an eye inside the volume, or one that the volume's path passes: draw again
    }
  }
}

TEST(EllipseOracle, EveryBeatOfEveryTechniqueAndMethod) {
  test::Random random(test::seed_or(81));
  OracleFigures figures;
  const auto config = load_config("ellipse");
  int number = 0;
  for (const auto method : {scene::Method::ImageAligned, scene::Method::AxisAligned, scene::Method::XRay})
    for (const int shapers : {0, 1, 2, 4, 8, 3, 5, 9, 6, 10, 12, 15, 15})
      for (int round = 0; round < 20; ++round, ++number) {
        const std::string name = std::string(scene::to_string(method)) + ", techniques " + std::to_string(shapers) +
                                 ", number " + std::to_string(number);
        compare_with_oracle(name, random_scene(random, config, method, shapers), config, figures);
      }
  print_and_expect_equal(figures);
  EXPECT_GT(figures.frames, 300U);
  EXPECT_GT(figures.refused, 0U);
  for (const auto member :
       {&scene_oracle::Met::ellipses, &scene_oracle::Met::ellipse_records, &scene_oracle::Met::thin_ellipses,
        &scene_oracle::Met::many_spans, &scene_oracle::Met::grown, &scene_oracle::Met::other_tiles})
    EXPECT_GT(figures.met.*member, 50U);
}

// Thin footprints exactly along a row: only their height grows (N-8-45, N-8-46).
TEST(EllipseOracle, EveryBeatOfThinFootprintsAlongARow) {
  test::Random random(test::seed_or(83));
  OracleFigures figures;
  const auto config = load_config("ellipse");
  for (int number = 0; number < 60; ++number)
    compare_with_oracle("along a row, number " + std::to_string(number),
                        random_scene(random, config, scene::Method::ImageAligned, kMotion | kRow), config, figures);
  print_and_expect_equal(figures);
  EXPECT_GT(figures.met.thin_ellipses, 50U);
}

// Other devices: random configurations with ellipses, in every kind of index that may have them.
TEST(EllipseOracle, EveryBeatOfRandomConfigurations) {
  test::Random random(test::seed_or(82));
  OracleFigures figures;
  constexpr cmodel::IndexKind kKinds[] = {cmodel::IndexKind::Rlut, cmodel::IndexKind::Separable,
                                          cmodel::IndexKind::Blit2d, cmodel::IndexKind::Squared,
                                          cmodel::IndexKind::SquaredElliptic};
  constexpr scene::Method kMethods[] = {scene::Method::ImageAligned, scene::Method::AxisAligned, scene::Method::XRay};
  for (int number = 0; number < 120; ++number) {
    const auto config = test::random_ellipse_config(random, kKinds[number % 5]);
    const auto shapers = static_cast<int>(random.between(0, kAll));
    compare_with_oracle("configuration " + std::to_string(number) + ", techniques " + std::to_string(shapers),
                        random_scene(random, config, kMethods[number % 3], shapers), config, figures);
  }
  print_and_expect_equal(figures);
  EXPECT_GT(figures.frames, 50U);
  EXPECT_GT(figures.met.ellipse_records, 1000U);
}

}  // namespace
}  // namespace fastsplat::driver
