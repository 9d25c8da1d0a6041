// SPDX-License-Identifier: Apache-2.0
// The files of scene/presets/ and scene/demos/, embedded at build time.
#pragma once

#include <string>
#include <vector>

namespace fastsplat::scene {

struct EmbeddedText {
  std::string name;  ///< the file's stem
  std::string text;  ///< the file's content
};

// Sorted by name.
const std::vector<EmbeddedText>& presets();  ///< transfer functions
const std::vector<EmbeddedText>& demos();    ///< scenes

}  // namespace fastsplat::scene
