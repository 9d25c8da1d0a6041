// SPDX-License-Identifier: Apache-2.0
// Every format keeps the place of a scan in the body and the directions of its axes.
#include "scene/volume/placement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "scene/volume/volume_file.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::volume {
namespace {

using ::testing::HasSubstr;

class Placed : public TemporaryFolder {
 protected:
  static Volume scan(const glm::dmat3& axes) {
    Volume volume =
        make_volume({5, 6, 7}, {0.5, 1.25, 3.0}, VoxelType::U8, [](int i, int j, int k) { return i + 5 * j + 30 * k; });
    volume.placed = true;
    volume.centre = {-3.5, 20.25, 7.0};
    if (axes != glm::dmat3(1.0)) volume.turn(axes);
    return volume;
  }
};

/// Turned about x, then about z.
glm::dmat3 turned(double pitch, double yaw) {
  const double degree = std::numbers::pi / 180.0;
  const double cp = std::cos(pitch * degree), sp = std::sin(pitch * degree);
  const double cy = std::cos(yaw * degree), sy = std::sin(yaw * degree);
  return glm::dmat3{{cy, sy, 0}, {-sy, cy, 0}, {0, 0, 1}} * glm::dmat3{{1, 0, 0}, {0, cp, sp}, {0, -sp, cp}};
}

TEST_F(Placed, IsKeptByEveryFormat) {
  const glm::dmat3 shear{{1, 0, 0}, {0, 1, 0}, {0, 0.6, 0.8}};
  double worst = 0.0;
  int kept = 0;
  for (const glm::dmat3& axes : {glm::dmat3(1.0), turned(18, 0), turned(-25, 30), shear}) {
    for (const char* ending : {".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd"}) {
      SCOPED_TRACE(ending);
      const Volume out = scan(axes);
      const auto path = folder_ / (std::string("v") + ending);
      save_volume(out, path, VoxelType::U8);
      for (const Volume& in : {load_volume(path.string()), read_volume_header(path.string())}) {
        EXPECT_EQ(in.oblique, out.oblique);
        EXPECT_TRUE(in.placed);
        EXPECT_EQ(in.dims, out.dims);
        for (const glm::ivec3 at : {glm::ivec3(0), {4, 5, 6}, {4, 0, 6}}) {
          const glm::dvec3 was = out.centre + out.position(at.x, at.y, at.z);
          worst = std::max(worst, glm::distance(was, in.centre + in.position(at.x, at.y, at.z)));
        }
        ++kept;
      }
      EXPECT_EQ(load_volume(path.string()).voxels, out.voxels);
    }
  }
  std::printf("[figure] kept_place = %d reads, worst %.2g mm (limit 1e-5)\n", kept, worst);
  EXPECT_LT(worst, 1e-5);  // NIfTI's matrix is in floats
}

TEST_F(Placed, TurnsWholeAxesFirst) {
  // Of a grid that is turned by 100 degrees about z, 90 are whole axes; 10 remain.
  const glm::dmat3 far = turned(0, 100);
  Volume volume =
      make_volume({2, 3, 4}, {1, 2, 3}, VoxelType::U8, [](int i, int j, int k) { return i + 2 * j + 6 * k; });
  place(volume, {.direction = {far[0], far[1], far[2]}});
  EXPECT_EQ(volume.dims, glm::ivec3(3, 2, 4));
  EXPECT_EQ(volume.spacing, glm::dvec3(2, 1, 3));
  EXPECT_EQ(volume.at(0, 0, 0), 4);  // the old y runs to the left now
  const Turn turn = turn_of(volume);
  EXPECT_NEAR(turn.degrees, 10.0, 1e-9);
  EXPECT_NEAR(turn.about.z, 1.0, 1e-9);
  EXPECT_NEAR(turn.shear, 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(volume.to_grid(volume.to_world({1, 2, 3})), glm::dvec3(1, 2, 3)), 0.0, 1e-12);
  std::printf("[figure] turn_left_of_100_degrees = %.9g\n", turn.degrees);
}

TEST_F(Placed, RoundingErrorsOfAPlacementAreStraight) {
  Volume volume = make_volume({2, 3, 4}, {1, 2, 3}, VoxelType::U8, [](int, int, int) { return 1; });
  const glm::dmat3 hair = turned(0.005, 0);
  place(volume, {.direction = {hair[0], hair[1], hair[2]}});
  EXPECT_FALSE(volume.oblique);
  EXPECT_EQ(volume.position(0, 0, 0), glm::dvec3(-0.5, -2.0, -4.5));
}

}  // namespace
}  // namespace fastsplat::volume
