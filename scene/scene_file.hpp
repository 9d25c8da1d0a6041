// A scene's file with all that it says: the still, its sequence, and what it says in vain.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "scene/capability.hpp"
#include "scene/sequence.hpp"

namespace fastsplat::scene {

struct SceneFile {
  SceneDescription description;
  std::optional<Sequence> sequence;
  /// Keys and tracks that mean nothing to the file's own scene, neither to the still nor to any frame. Flags may yet
  /// give them a meaning; if they do not, refuse_idle tells the first.
  std::vector<Given> idle;
};

/// As load_scene_file, but what is idle is left to the caller.
SceneFile read_scene_file(const std::filesystem::path& path);

}  // namespace fastsplat::scene
