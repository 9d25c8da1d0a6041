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

/// One SceneFlags per name; the flags alone if there are no names. UserError (Usage) if --scene is also given, or a
/// name is empty or repeated.
std::vector<SceneFlags> scenes_of(const SceneList& list);
/// Files that the command reads.
std::vector<std::string> inputs_of(const SceneList& list);

}  // namespace fastsplat::cli
