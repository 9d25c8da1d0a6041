// SPDX-License-Identifier: Apache-2.0
// The metadata of a render names all of its inputs and survives a file.
#include "analysis/provenance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/images/image_helper.hpp"

namespace fastsplat::analysis {
namespace {

TEST(Provenance, NamesEngineMethodSceneVersionAndConfiguration) {
  scene::SceneDescription scene;
  scene.volume = "shells:32";
  scene.method = scene::Method::XRay;
  const images::Metadata golden = render_metadata("golden", scene);
  EXPECT_EQ(golden.at("engine"), "golden");
  EXPECT_EQ(golden.at("method"), "xray");
  EXPECT_EQ(golden.at("scene"), scene::to_toml(scene));
  EXPECT_THAT(golden.at("version"), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_FALSE(golden.contains("config"));

  const images::Metadata device = render_metadata("cmodel", scene, HardwareConfig{.name = "base", .hash = 0x1f});
  EXPECT_EQ(device.at("config"), "base");
  EXPECT_EQ(device.at("config_hash"), "000000000000001f");
}

TEST(Provenance, TheSceneInAFileRendersAgain) {
  const images::TempFolder folder;
  scene::SceneDescription scene;
  scene.volume = "marschner-lobb:41";
  scene.camera.azimuth = 33.25;
  scene.slab_width = 0.5;
  for (const char* name : {"a.exr", "a.png", "a.tif"}) {
    images::write_image(folder / name, images::random_image(4, 4, 4, 1), render_metadata("golden", scene));
    images::write_bytes(folder / "scene.toml", images::read_image(folder / name).metadata.at("scene"));
    EXPECT_EQ(scene::to_toml(scene::load_scene_file(folder / "scene.toml")), scene::to_toml(scene)) << name;
  }
}

}  // namespace
}  // namespace fastsplat::analysis
