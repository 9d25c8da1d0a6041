// Several scenes of one command: files or demos named one after the other, the scene flags over each of them.
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

/// A scene's flags for each name; the flags alone where there is no name. UserError (Usage) where --scene names one,
/// too, a name is empty or stands there twice.
std::vector<SceneFlags> scenes_of(const SceneList& list);
/// What the command reads.
std::vector<std::string> inputs_of(const SceneList& list);

}  // namespace fastsplat::cli
