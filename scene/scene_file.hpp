// SPDX-License-Identifier: Apache-2.0
// The content of a scene's file: the still, its sequence, and settings without effect.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/capability.hpp"
#include "scene/sequence.hpp"

namespace fastsplat::scene {

struct SceneFile {
  SceneDescription description;
  std::optional<Sequence> sequence;
  /// Keys and tracks without effect on the file's own scene, neither on the still nor on any frame. Flags may still
  /// give them an effect; if not, refuse_idle reports the first.
  std::vector<Given> idle;
};

/// Like load_scene_file, but the caller handles settings without effect.
SceneFile read_scene_file(const std::filesystem::path& path);
/// The content of a scene's file; `source` names it in messages. Relative paths stay relative to the current folder.
SceneFile parse_scene(const std::string& text, const std::string& source);

}  // namespace fastsplat::scene
