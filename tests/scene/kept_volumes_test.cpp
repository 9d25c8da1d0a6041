// SPDX-License-Identifier: Apache-2.0
// Scenes of a kept volume are those read from its file, and no file is read for them.
#include "scene/kept_volumes.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "base/error.hpp"
#include "scene/scene_file.hpp"
#include "scene/splat_store.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::scene {
namespace {

namespace fs = std::filesystem;

TEST(KeptVolumes, AreFoundWithoutTheirFiles) {
  const fs::path file = fs::path(::testing::TempDir()) / "kept.nrrd";
  volume::save_volume(volume::load_volume("shells:20"), file, volume::VoxelType::F32);
  SceneDescription description;
  description.volume = file.string();
  const Scene read = build_scene(description);
  EXPECT_EQ(read.store, nullptr) << "nothing is kept unless asked for";
  keep_volume(description);
  fs::remove(file);

  SceneDescription turned = description, cropped = description, replaced = description, recoloured = description;
  turned.camera.azimuth = 77.0;
  cropped.crop = VoxelBox{.low = glm::ivec3(2), .high = glm::ivec3(9)};
  replaced.nan_as = 3.0;
  recoloured.transfer_function = "ct-head";
  const Scene kept = build_scene(description), other = build_scene(turned);
  EXPECT_EQ(kept.volume, other.volume);
  EXPECT_EQ(kept.store, other.store);
  EXPECT_EQ(kept.volume->voxels, read.volume->voxels);
  EXPECT_EQ(to_toml(kept.description), to_toml(read.description));
  ASSERT_NE(kept.store, nullptr);
  const std::size_t bytes = kept.store->bytes();
  std::printf("[figure] bytes of classified voxels kept = %zu (limit > 0)\n", bytes);
  EXPECT_GT(bytes, 0u);
  kept.store->open(other);
  EXPECT_EQ(kept.store->bytes(), bytes) << "what was classified serves every view";

  EXPECT_EQ(build_scene(cropped).store, nullptr) << "a cropped volume has other voxels";
  EXPECT_EQ(build_scene(recoloured).store, nullptr) << "they were classified otherwise";
  EXPECT_THROW(build_scene(replaced), UserError) << "NaN was not replaced in the kept one";
  forget_volume(description);
  EXPECT_THROW(build_scene(description), UserError);
}

}  // namespace
}  // namespace fastsplat::scene
