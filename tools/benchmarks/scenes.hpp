// SPDX-License-Identifier: Apache-2.0
// Scenes of the benchmarks: a head from Debian (mricron-data), and generated volumes. Each is read once.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "scene/scene.hpp"

namespace fastsplat::bench {

inline constexpr const char* kHead = "/usr/share/mricron/templates/ch2bet.nii.gz";

inline scene::SceneDescription description_of(const std::string& volume, int size) {
  scene::SceneDescription description;
  description.volume = volume;
  description.transfer_function = volume == kHead ? "mri-head" : "default";
  description.width = description.height = size;
  return description;
}

/// Cached until the program ends, because only frames are measured.
inline const scene::Scene& scene_of(const std::string& volume, int size) {
  static std::map<std::pair<std::string, int>, scene::Scene> scenes;
  const auto found = scenes.find({volume, size});
  if (found != scenes.end()) return found->second;
  return scenes.emplace(std::pair{volume, size}, scene::build_scene(description_of(volume, size))).first->second;
}

}  // namespace fastsplat::bench
