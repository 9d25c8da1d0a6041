// SPDX-License-Identifier: Apache-2.0
// The automatic exposure: the densest line of voxels against sums line by line, and the resulting brightness of X-rays.
#include "scene/xray_exposure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/splats.hpp"
#include "scene/volume/synthetic.hpp"
#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

SceneDescription xray_from(double azimuth, double elevation) {
  SceneDescription description;
  description.method = Method::XRay;
  description.transfer_function = "linear";
  description.camera.azimuth = azimuth;
  description.camera.elevation = elevation;
  return description;
}

Scene exposed(const SceneDescription& description, volume::Volume volume) {
  return build_scene(description, std::make_shared<const volume::Volume>(std::move(volume)));
}

/// The definition for one voxel's line in one direction, walked from that voxel on.
double from_voxel(const volume::Volume& volume, const Classifier& classify, glm::ivec3 at, const glm::ivec3& step) {
  const double length = glm::length(glm::dvec3(step) * volume.spacing) / volume.kernel_unit();
  double sum = 0.0;
  while (at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < volume.dims.x && at.y < volume.dims.y && at.z < volume.dims.z) {
    sum += static_cast<double>(classify(volume.at(at.x, at.y, at.z)).extinction);
    at += step;
  }
  return sum * length;
}

// N-8-24: in each volume one line stands out, of each of the 26 directions in turn, through the middle or a corner.
TEST(XrayExposure, TheDensestLineIsThatOfAll26Directions) {
  int lines = 0;
  double worst = 0.0;
  for (const glm::ivec3 dims : {glm::ivec3(7, 6, 5), glm::ivec3(5, 5, 5), glm::ivec3(9, 1, 4), glm::ivec3(2, 8, 3)}) {
    for (int n = 0; n < 27 * 9; ++n) {
      const glm::ivec3 along(n % 3 - 1, n / 3 % 3 - 1, n / 9 % 3 - 1);
      if (along == glm::ivec3(0)) continue;
      const int place = n / 27;  // 8: the middle
      const glm::ivec3 through =
          place == 8 ? dims / 2 : glm::ivec3(place & 1, place >> 1 & 1, place >> 2 & 1) * (dims - 1);
      const volume::Volume volume =
          make_volume(dims, {1.0, 1.5, 0.75}, volume::VoxelType::F32, [&](int i, int j, int k) {
            const glm::ivec3 away = glm::ivec3(i, j, k) - through;
            const int steps = along.x != 0 ? away.x * along.x : along.y != 0 ? away.y * along.y : away.z * along.z;
            return away == steps * along ? 250 : (3 * i + 5 * j + 7 * k) % 11;
          });
      const Classifier classify(load_transfer_function("linear"), volume);
      double expected = 0.0;
      for (int d = 0; d < 27; ++d) {
        const glm::ivec3 step(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1);
        if (step == glm::ivec3(0)) continue;
        for (int v = 0; v < dims.x * dims.y * dims.z; ++v, ++lines)
          expected = std::max(
              expected, from_voxel(volume, classify, {v % dims.x, v / dims.x % dims.y, v / (dims.x * dims.y)}, step));
      }
      ASSERT_GT(expected, 0.0);
      worst = std::max(worst, std::abs(densest_line(volume, classify) / expected - 1.0));
    }
  }
  std::printf("[figure] lines summed = %d, densest off by at most %.1e\n", lines, worst);
  EXPECT_LT(worst, 1e-14);  // sums of at most 9 doubles in two orders
  EXPECT_GT(lines, 100000);
}

// N-8-23.
TEST(XrayExposure, NothingVisibleHasExposureOne) {
  const volume::Volume volume =
      make_volume({3, 3, 3}, glm::dvec3(1.0), volume::VoxelType::U8, [](int i, int, int) { return i; });
  TransferFunction nothing = load_transfer_function("linear");
  for (auto& point : nothing.points) point.opacity = 0.0;
  EXPECT_EQ(automatic_exposure(volume, Classifier(nothing, volume), 1.0), 1.0);
}

// Few voxels in a large volume: bright in the brightest view, the rods seen end-on, and in the same proportion from
// elsewhere. (By the volume's diagonal alone they would have a third of it.)
TEST(XrayExposure, SparseVolumesAreNotDark) {
  const volume::Volume rods =
      make_volume({64, 64, 64}, glm::dvec3(1.0), volume::VoxelType::U8,
                  [](int i, int j, int k) { return (i % 16 == 8 && j % 16 == 8) || (k == 20 && i == j) ? 200 : 0; });
  double best = 0.0;
  for (const auto& [azimuth, elevation] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {0.0, 90.0}, {45.0, 0.0}, {20.0, 30.0}}) {
    const Scene scene = exposed(xray_from(azimuth, elevation), rods);
    const double reach = scene.kernel.radius();
    const auto splats = collect_splats(scene);
    double brightest = 0.0;
    for (const Splat& centre : splats) {  // a ray through each voxel
      const glm::dvec3 c = centre.position;
      double sum = 0.0;
      for (const Splat& s : splats) {
        const glm::dvec3 d = glm::dvec3(s.position) - c;
        const double x = glm::dot(d, scene.camera.right()), y = glm::dot(d, scene.camera.down());
        if (x * x + y * y < reach * reach)
          sum += static_cast<double>(s.extinction) * scene.kernel.footprint(x * x + y * y);
      }
      brightest = std::max(brightest, sum * scene.xray_scale);
    }
    std::printf("[figure] rods from %g, %g: brightest ray = %.3f\n", azimuth, elevation, brightest);
    EXPECT_LE(brightest, 1.0);
    EXPECT_GT(brightest, 0.5 / 64);  // one voxel where 64 have 1, in a footprint of about half a voxel's peak
    best = std::max(best, brightest);
  }
  EXPECT_GT(best, 0.4);
}

}  // namespace
}  // namespace fastsplat::scene
