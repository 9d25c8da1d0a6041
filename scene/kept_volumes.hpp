// SPDX-License-Identifier: Apache-2.0
// Volumes kept in memory: build_scene() finds them in this process and in its forks instead of reading their files.
#pragma once

#include <memory>

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// A volume with what frames of it share.
struct KeptVolume {
  std::shared_ptr<const volume::Volume> volume;
  std::shared_ptr<SplatStore> store;  ///< null if the first scene was cropped
};

/// Reads the description's volume and classifies its voxels. Keeps nothing if all kept volumes would take more than
/// usual_store_bytes(), or if it is kept already. Throws as build_scene() does. Starts no thread.
void keep_volume(const SceneDescription& description);
/// Forgets it; forks that have it keep it.
void forget_volume(const SceneDescription& description);
/// Null members if it is not kept.
KeptVolume kept_volume(const SceneDescription& description);

}  // namespace fastsplat::scene
