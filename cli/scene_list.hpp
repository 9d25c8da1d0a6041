// SPDX-License-Identifier: Apache-2.0
// Several scenes of one command: a list of files or demos; the scene flags apply to each.
#pragma once

#include <string>
#include <vector>

#include "cli/scene_flags.hpp"
#include "scene/scene.hpp"

namespace fastsplat::cli {

struct SceneList {
  SceneFlags flags;
  std::vector<std::string> names;  ///< each "A" or "A,B": --scenes may be repeated
};

void declare(Options& options, SceneList& to);

/// One SceneFlags per name of the list. Without a list: one SceneFlags, that of the options. UserError (Usage) if
/// --scene and a list are both given, or a name is empty or repeated.
std::vector<SceneFlags> scenes_of(const SceneList& list);
/// Files that the command reads.
std::vector<std::string> inputs_of(const SceneList& list);

}  // namespace fastsplat::cli
