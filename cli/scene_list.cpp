// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_list.hpp"

#include <algorithm>
#include <sstream>

#include "base/error.hpp"
#include "cli/output_names.hpp"

namespace fastsplat::cli {
namespace {

std::vector<std::string> split(const std::vector<std::string>& lists) {
  std::vector<std::string> names;
  for (const std::string& list : lists) {
    std::istringstream words(list + ",");
    for (std::string word; std::getline(words, word, ',');) {
      const bool twice = std::ranges::find(names, word) != names.end();
      if (word.empty() || twice) {
        throw_usage({.where = "--scenes",
                     .what = word.empty() ? "contains an empty name" : "contains a scene twice",
                     .expected = "names separated by commas, each once",
                     .got = "'" + list + "'",
                     .fix = "for example --scenes a.toml,demo:fire"});
      }
      names.push_back(word);
    }
  }
  return names;
}

}  // namespace

void declare(Options& options, SceneList& to) {
  declare(options, to.flags);
  options.group("Scene");
  options.words("--scenes", to.names, "A,B",
                "several scenes, files or demo:NAME; flags override settings of each; repeatable");
}

std::vector<SceneFlags> scenes_of(const SceneList& list) {
  const auto names = split(list.names);
  if (names.empty()) return {list.flags};
  if (list.flags.file) {
    throw_usage({.where = "--scene",
                 .what = "cannot be combined with --scenes",
                 .expected = {},
                 .got = {},
                 .fix = "use one of them, or add this scene to --scenes"});
  }
  std::vector<SceneFlags> scenes;
  for (const std::string& name : names) {
    scenes.push_back(list.flags);
    scenes.back().file = name;
  }
  return scenes;
}

std::vector<std::string> inputs_of(const SceneList& list) {
  std::vector<std::string> inputs;
  for (const SceneFlags& scene : scenes_of(list)) inputs = joined(std::move(inputs), inputs_of(scene));
  return inputs;
}

}  // namespace fastsplat::cli
