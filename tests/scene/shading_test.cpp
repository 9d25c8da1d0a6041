// SPDX-License-Identifier: Apache-2.0
#include "scene/shading.hpp"

#include <gtest/gtest.h>

#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

// N-8-20: neighbours, and ends.
TEST(Gradient, IsExactOnALinearRamp) {
  // Powers of two: every operation is exact, borders included.
  const glm::dvec3 spacing(0.5, 1.0, 2.0);
  const volume::Volume volume = make_volume({5, 4, 6}, spacing, volume::VoxelType::F32,
                                            [](int i, int j, int k) { return 3 * i - 8 * j + 5 * k + 7; });
  int compared = 0;
  for (int k = 0; k < 6; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 5; ++i, ++compared) EXPECT_EQ(gradient(volume, i, j, k), glm::vec3(6.0f, -8.0f, 2.5f));
    }
  }
  EXPECT_EQ(compared, 120);
}

// N-8-20.
TEST(Gradient, IsZeroAlongAnAxisOfOneVoxel) {
  const volume::Volume volume =
      make_volume({3, 1, 1}, glm::dvec3(1), volume::VoxelType::F32, [](int i, int, int) { return i * i; });
  EXPECT_EQ(gradient(volume, 1, 0, 0), glm::vec3(2, 0, 0));
}

class Light : public ::testing::Test {
 protected:
  static volume::Volume ramp(glm::dvec3 slope) {
    return make_volume({5, 5, 5}, glm::dvec3(1), volume::VoxelType::F32,
                       [slope](int i, int j, int k) { return glm::dot(slope, glm::dvec3(i, j, k)); });
  }
  static glm::vec3 shade(const volume::Volume& volume, Shading shading) {
    const Camera camera({.azimuth = 0.0, .elevation = 0.0}, volume, 1.0, 10, 10);
    const Shader shader(shading, camera, volume);
    return shader(glm::vec3(0.5f), shader.surface(2, 2, 2));
  }
  Shading shading_{
      .on = true, .ambient = 0.25, .diffuse = 0.75, .specular = 0.0, .shininess = 10.0, .gradient_floor = 0.0};
};

// N-8-19.
TEST_F(Light, ComesFromAboveLeftOfTheEye) {
  // Seen along -y: the eye is at +y, up is +z, the image's left is +x.
  const float towards_eye = shade(ramp({0, 1, 0}), shading_).x;
  const float towards_left = shade(ramp({1, 1, 0}), shading_).x;
  const float towards_right = shade(ramp({-1, 1, 0}), shading_).x;
  const float upwards = shade(ramp({0, 1, 1}), shading_).x;
  const float downwards = shade(ramp({0, 1, -1}), shading_).x;
  EXPECT_GT(towards_left, towards_right);
  EXPECT_GT(upwards, downwards);
  EXPECT_GT(towards_eye, downwards);
}

TEST_F(Light, IsTwoSided) { EXPECT_EQ(shade(ramp({1, 2, 3}), shading_), shade(ramp({-1, -2, -3}), shading_)); }

// N-8-21.
TEST_F(Light, NeverLeavesTheUnitRange) {
  shading_.specular = 1.0;
  shading_.ambient = 1.0;
  const glm::vec3 bright = shade(ramp({0.35, 1, 0.5}), shading_);  // straight into the light
  EXPECT_EQ(bright, glm::vec3(1.0f));
}

// N-8-21: floor.
TEST_F(Light, LeavesWeakGradientsAlone) {
  const volume::Volume flat =
      make_volume({5, 5, 5}, glm::dvec3(1), volume::VoxelType::F32, [](int i, int, int) { return i == 0 ? 100 : 0; });
  EXPECT_EQ(shade(flat, shading_), glm::vec3(0.5f));  // no gradient at all
  shading_.gradient_floor = 0.3;                      // the ramp's is 1/4 of its range per kernel unit
  EXPECT_EQ(shade(ramp({1, 0, 0}), shading_), glm::vec3(0.5f));
  shading_.gradient_floor = 0.1;
  EXPECT_NE(shade(ramp({1, 0, 0}), shading_), glm::vec3(0.5f));
}

}  // namespace
}  // namespace fastsplat::scene
