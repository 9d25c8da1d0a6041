// SPDX-License-Identifier: Apache-2.0
// A scene's text, from a file or built in, as a TOML document.
#pragma once

#include <filesystem>

#include "scene/toml_reader.hpp"

namespace fastsplat::scene {

/// `path` is a scene.toml or "demo:NAME", as for load_scene_file.
TomlTable open_scene(const std::filesystem::path& path);

}  // namespace fastsplat::scene
