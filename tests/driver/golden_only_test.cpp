// SPDX-License-Identifier: Apache-2.0
// Techniques that the device lacks are refused by name, never ignored silently.
#include <gtest/gtest.h>

#include <vector>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

TEST(GoldenOnly, techniques_are_refused_by_their_key) {
  const auto config = load_config("small");
  auto plain = view_of("point:9", 16);
  plain.camera.projection = scene::Projection::Perspective;
  EXPECT_NO_THROW(CompiledFrame(scene::build_scene(plain), config));

  std::vector<std::pair<std::string, scene::SceneDescription>> scenes;
  const auto with = [&](const char* key) -> scene::SceneDescription& { return scenes.emplace_back(key, plain).second; };
  with("footprint.shape").footprint.shape = scene::FootprintShape::Ellipse;
  with("footprint.antialias").footprint.antialias = true;
  with("splat_texture.amplitude").footprint.texture.amplitude = 0.5;
  with("motion.translate").motion.translate = {0.0, 0.1, 0.0};
  with("motion.orbit").motion.orbit = 1.0;
  with("lens.depth_of_field").lens.depth_of_field = scene::DepthOfField::Splats;

  with("culling.freeze").culling.freeze = 0.01;
  with("culling.mode").culling = {.mode = scene::CullingMode::Blocks, .freeze = 0.01};
  with("classify.order").classify = scene::ClassifyOrder::Post;
  with("texture.where").texture.kind = scene::SolidKind::Marble;
  auto& bumpy = with("classify.order");
  bumpy.classify = scene::ClassifyOrder::Post;
  bumpy.bump.kind = scene::SolidKind::Noise;
  bumpy.shading = 1;

  for (const auto& [key, description] : scenes) {
    try {
      CompiledFrame(scene::build_scene(description), config);
      ADD_FAILURE() << key << " was accepted";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      EXPECT_EQ(std::string(error.what()).rfind(key, 0), 0u) << error.what();
      EXPECT_NE(std::string(error.what()).find("--engine golden"), std::string::npos) << error.what();
    }
  }
}

// N-8-18: a texture at the voxels also works on the device: the splats come tinted.
TEST(GoldenOnly, textured_voxels_are_the_devices_too) {
  auto description = view_of("shells:24", 96);
  const Image plain = golden::render(scene::build_scene(description));
  description.texture = {scene::SolidKind::Marble, scene::TextureWhere::Voxel, 8.0, 1.0};
  const auto scene = scene::build_scene(description);
  const Image golden = golden::render(scene);
  const auto apart = distance(golden, to_image(render(scene, load_config("base")).frame));
  figure("textured_voxels, device minus golden, largest", apart.largest, "8-bit steps, limit 3");
  EXPECT_GT(distance(golden, plain).largest, 20.0);
  EXPECT_LE(apart.largest, 3.0);
  EXPECT_GT(apart.largest, 0.0);
}

}  // namespace
}  // namespace fastsplat::driver
