// SPDX-License-Identifier: Apache-2.0
// Which program, engine, scene and configuration made a picture: the metadata of every render.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/images/image_file.hpp"
#include "scene/scene.hpp"

namespace fastsplat::analysis {

struct HardwareConfig {
  std::string name;  ///< `base`, or the file it came from
  std::uint64_t hash = 0;
};

/// Keys engine, method, scene (TOML that load_scene_file reads), version, and with a configuration config, config_hash.
images::Metadata render_metadata(const std::string& engine, const scene::SceneDescription& scene,
                                 const std::optional<HardwareConfig>& config = {});

/// The same for a scene that has been built: also volume (where it came from) and content_hash. The scene's text names
/// files; the hash shows whether their content is still the same.
images::Metadata render_metadata(const std::string& engine, const scene::Scene& scene,
                                 const std::optional<HardwareConfig>& config = {});

/// Hash of the voxels, their grid and the transfer function.
std::uint64_t content_hash(const scene::Scene& scene);

}  // namespace fastsplat::analysis
