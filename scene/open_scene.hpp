// A scene's text, from a file or built in, as a TOML document.
#pragma once

#include <filesystem>

#include "scene/toml_reader.hpp"

namespace fastsplat::scene {

/// As load_scene_file, whose path it is.
TomlTable open_scene(const std::filesystem::path& path);

}  // namespace fastsplat::scene
