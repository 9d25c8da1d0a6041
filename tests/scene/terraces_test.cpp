// SPDX-License-Identifier: Apache-2.0
// Pictures classified by pixel show slabs as rings and the kernel's ripple as stripes where voxels are large: a
// warning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/number_text.hpp"
#include "scene/scene.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::scene {
namespace {

/// A head of 3.2 x 3.2 x 1.5 mm whose air is 390 and not the least value.
std::shared_ptr<const volume::Volume> head() {
  return std::make_shared<const volume::Volume>(
      volume::make_volume({32, 36, 64}, {3.2, 3.2, 1.5}, volume::VoxelType::U16, [](int i, int j, int k) {
        if (i + j + k == 0) return 0.0;
        const glm::dvec3 place((i - 15.5) * 3.2 / 40, (j - 17.5) * 3.2 / 48, (k - 31.5) * 1.5 / 40);
        return std::round(390.0 + 510.0 / (1.0 + std::exp(100.0 * (glm::length(place) - 1.0))));
      }));
}

std::string remark_of(const SceneDescription& description) {
  const Scene scene = build_scene(description, head());
  const auto found = std::find_if(scene.remarks.begin(), scene.remarks.end(),
                                  [](const auto& text) { return text.starts_with("classified by pixel"); });
  return found == scene.remarks.end() ? "" : *found;
}

SceneDescription large() {
  SceneDescription d;
  d.width = d.height = 300;
  d.camera.azimuth = 30, d.camera.elevation = 15;
  d.classify = ClassifyOrder::Post;
  return d;
}

TEST(Terraces, AreSaidWithAWayOut) {
  const std::string said = remark_of(large());
  std::printf("%s\n", said.c_str());
  const std::string flag = "--slab-width ";
  const auto at = said.find(flag);
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(said.find("and --kernel smooth"), std::string::npos);
  const auto width = number_from(said.substr(at + flag.size(), said.find(' ', at + flag.size()) - at - flag.size()));
  ASSERT_TRUE(width);
  SceneDescription thin = large();
  thin.slab_width = *width;
  EXPECT_EQ(remark_of(thin).find(flag), std::string::npos);
  EXPECT_NE(remark_of(thin).find("use --kernel smooth"), std::string::npos);
  thin.kernel = "smooth";
  EXPECT_EQ(remark_of(thin), "");
}

TEST(Terraces, AreNotSaidWhereNoneAreSeen) {
  SceneDescription small = large();
  small.width = small.height = 100;
  EXPECT_EQ(remark_of(small), "") << "voxels of less than two pixels";
  SceneDescription pre = large();
  pre.classify = ClassifyOrder::Pre;
  EXPECT_EQ(remark_of(pre), "");
  SceneDescription flat = large();
  flat.shading = 0;
  EXPECT_EQ(remark_of(flat).find("--kernel"), std::string::npos) << "without shading there are no normals";
}

}  // namespace
}  // namespace fastsplat::scene
