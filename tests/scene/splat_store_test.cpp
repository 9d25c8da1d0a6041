// SPDX-License-Identifier: Apache-2.0
// The store's splats are those of the traversal, in every view; it keeps no more than it may and nothing stale.
#include "scene/splat_store.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <thread>

namespace fastsplat::scene {
namespace {

SceneDescription view(double azimuth) {
  SceneDescription description;
  description.volume = "shells:21";  // its last bricks are not whole
  description.transfer_function = "ct-head";
  description.camera.azimuth = azimuth;
  description.shading = 1;
  return description;
}

using Key = std::array<float, 3>;
struct Seen {
  Key emission;
  float extinction;
  int sheet;
  bool operator==(const Seen&) const = default;
};
using Splats = std::map<Key, Seen>;
Key key(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Splats by_traversal(const Scene& scene) {
  Splats out;
  for (const Splat& one : collect_splats(scene))
    out[key(one.position)] = {key(one.emission), one.extinction, one.sheet};
  return out;
}

/// From an open store.
Splats by_store(SplatStore& store, const Scene& scene) {
  const VoxelSplats voxels(scene, SplatKind::Colours, store.classifier());
  Splats out;
  BrickSplats scratch;
  for (std::size_t brick = 0; brick < store.bricks().size(); ++brick) {
    const BrickSplats& splats = store.splats(voxels, brick, scratch);
    for (std::size_t i = 0; i < splats.splats.size(); ++i) {
      const auto& [splat, at] = splats.splats[i];
      const glm::ivec3 voxel = store.bricks()[brick].low + glm::ivec3(at[0], at[1], at[2]);
      out[key(splats.position(i))] = {key(voxels.emission(splat)), splat.extinction, voxels.slice(voxel)};
    }
  }
  return out;
}

void expect_same(SplatStore& store, const Scene& scene, const char* what) {
  store.open(scene);
  const Splats a = by_traversal(scene), b = by_store(store, scene);
  std::printf("[figure] splats compared, %s = %zu, kept bytes = %zu\n", what, a.size(), store.bytes());
  ASSERT_FALSE(a.empty());
  EXPECT_TRUE(a == b) << what;
}

TEST(SplatStore, HasTheTraversalsSplatsInEveryView) {
  for (const std::size_t room : {std::size_t{0}, std::size_t{50'000}, std::size_t{1} << 30}) {
    SplatStore store(room);
    Scene scene = build_scene(view(0));
    const auto volume = scene.whole;
    for (const double azimuth : {0.0, 40.0, 200.0}) {
      scene = build_scene(view(azimuth), volume);
      expect_same(store, scene, "a view");
      EXPECT_EQ(store.bytes() > 0, room > 0);
      EXPECT_LT(store.bytes(), room + 30'000);  // a brick more
    }
  }
}

// Whatever changes the splats themselves.
TEST(SplatStore, ForgetsSplatsOfAnotherScene) {
  SplatStore store(std::size_t{1} << 30);
  const Scene first = build_scene(view(10));
  expect_same(store, first, "first");
  const auto changed = [&](const char* what, auto change) {
    SceneDescription description = view(10);
    change(description);
    expect_same(store, build_scene(description, first.whole), what);
    expect_same(store, first, "back again");
  };
  changed("transfer function", [](auto& d) { d.transfer_function = "binary"; });
  changed("opacity", [](auto& d) { d.opacity_scale = 0.5; });
  changed("shading", [](auto& d) { d.shading = 0; });
  changed("crop", [](auto& d) { d.crop = *box_from("2..9,3..12,0..20"); });
  changed("texture", [](auto& d) { d.texture = {.kind = SolidKind::Wood, .where = TextureWhere::Voxel}; });
  Scene floor = first;
  floor.shading.gradient_floor = 0.3;
  expect_same(store, floor, "gradient floor");
  expect_same(store, build_scene([] {
                auto d = view(10);
                d.volume = "shells:20";
                return d;
              }()),
              "volume");
}

TEST(SplatStore, ServesSeveralThreads) {
  const Scene scene = build_scene(view(25));
  const Splats expected = by_traversal(scene);
  SplatStore store(std::size_t{1} << 30);
  store.open(scene);
  std::array<Splats, 4> found;
  {
    std::vector<std::jthread> threads;
    for (auto& one : found) threads.emplace_back([&] { one = by_store(store, scene); });
  }
  for (const auto& one : found) EXPECT_TRUE(one == expected);
  SplatStore alone(std::size_t{1} << 30);
  alone.open(scene);
  by_store(alone, scene);
  EXPECT_EQ(store.bytes(), alone.bytes());
}

}  // namespace
}  // namespace fastsplat::scene
