// The transfer functions of scene/presets/*.toml, embedded at build time.
#pragma once

#include <string>
#include <vector>

namespace fastsplat::scene {

struct Preset {
  std::string name;  ///< the file's stem
  std::string text;  ///< the file's content
};

/// Sorted by name.
const std::vector<Preset>& presets();

}  // namespace fastsplat::scene
