// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/volume/volume_testing.hpp"

namespace fastsplat::volume {
namespace {

TEST(Synthetic, AllNamesGiveCubesInRange) {
  ASSERT_EQ(synthetic_names().size(), 11u);
  for (const auto& name : synthetic_names()) {
    const Volume volume = make_synthetic(name, 17);
    EXPECT_EQ(volume.dims, glm::ivec3(17)) << name;
    EXPECT_EQ(volume.voxels.size(), 17u * 17 * 17);
    EXPECT_EQ(volume.name, name + ":17");
    EXPECT_GE(volume.min, 0.0f);
    EXPECT_LE(volume.max, 1.0f);
    EXPECT_GT(volume.max, 0.0f) << name << " is empty";
    EXPECT_NO_THROW(make_synthetic(name, 2));
    EXPECT_GE(default_synthetic_size(name), 2);
    EXPECT_TRUE(describe_synthetic(name, 17).voxels.empty());
  }
}

TEST(Synthetic, ContentMatchesItsName) {
  const Volume cube = make_synthetic("binary-cube", 32);
  EXPECT_EQ(std::count(cube.voxels.begin(), cube.voxels.end(), 1.0f), 16 * 16 * 16);
  EXPECT_EQ(std::count(cube.voxels.begin(), cube.voxels.end(), 0.0f), 32 * 32 * 32 - 16 * 16 * 16);
  const Volume point = make_synthetic("point", 9);
  EXPECT_EQ(point.at(4, 4, 4), 1.0f);
  EXPECT_EQ(std::count(point.voxels.begin(), point.voxels.end(), 0.0f), 9 * 9 * 9 - 1);
  const Volume constant = make_synthetic("constant", 5);
  EXPECT_EQ(constant.min, 1.0f);
  const Volume floor = make_synthetic("checkerboard-floor", 8);
  EXPECT_EQ(floor.at(0, 0, 0), 1.0f);
  EXPECT_EQ(floor.at(2, 0, 1), 0.5f);
  EXPECT_EQ(floor.at(2, 2, 0), 1.0f);
  EXPECT_EQ(floor.at(0, 0, 2), 0.0f);
  const Volume tunnel = make_synthetic("checkerboard-tunnel", 8);
  EXPECT_GT(tunnel.at(0, 3, 4), 0.0f);
  EXPECT_GT(tunnel.at(4, 3, 7), 0.0f);
  EXPECT_EQ(tunnel.at(4, 3, 4), 0.0f);
  const Volume layer = make_synthetic("layer", 6);
  EXPECT_EQ(std::count(layer.voxels.begin(), layer.voxels.end(), 1.0f), 6 * 6);
  EXPECT_EQ(layer.at(5, 0, 3), 1.0f);
  const Volume pair = make_synthetic("pair", 4);
  EXPECT_EQ(std::count(pair.voxels.begin(), pair.voxels.end(), 0.0f), 4 * 4 * 4 - 2);
  EXPECT_EQ(pair.at(1, 2, 2), 0.5f);
  EXPECT_EQ(pair.at(2, 2, 2), 1.0f);
}

TEST(Synthetic, MarschnerLobbIsTheirFormula) {
  constexpr int n = 41;
  const Volume volume = make_synthetic("marschner-lobb", n);
  const double pi = std::numbers::pi;
  double worst = 0.0;
  for (int k = 0; k < n; k += 5) {
    for (int i = 0; i < n; i += 3) {
      const double x = -1 + i * 0.05, z = -1 + k * 0.05, r = std::abs(x);  // y = 0 at index 20
      const double expected =
          ((1 - std::sin(pi * z / 2)) + 0.25 * (1 + std::cos(12 * pi * std::cos(pi * r / 2)))) / 2.5;
      worst = std::max(worst, std::abs(expected - static_cast<double>(volume.at(i, 20, k))));
    }
  }
  const double limit = 2e-7;  // rounding to float, and the argument of the cosine up to 38
  std::printf("[figure] marschner-lobb against formula = %.3g (limit %.3g)\n", worst, limit);
  EXPECT_LE(worst, limit);
}

TEST(Synthetic, RefusesNamesAndSizes) {
  EXPECT_THAT(refusal([] { make_synthetic("shels", 8); }), ::testing::HasSubstr("did you mean 'shells'?"));
  for (const int size : {-1, 0, 1, 1025}) {
    EXPECT_THAT(refusal([&] { make_synthetic("shells", size); }), ::testing::HasSubstr("expected 2..1024"));
  }
}

}  // namespace
}  // namespace fastsplat::volume
