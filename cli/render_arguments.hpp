// SPDX-License-Identifier: Apache-2.0
// Arguments of `render`: a still, or an animation if --orbit or --sequence is given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/common.hpp"
#include "cli/config_flags.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/scene_flags.hpp"
#include "cli/wave_flags.hpp"

namespace fastsplat::cli {

struct RenderArguments {
  Common common;
  SceneFlags scene;
  GaussianFlags gaussians;  ///< instead of a volume's scene
  std::string engine = "golden";
  ConfigFlags config;
  std::vector<std::string> out;
  std::string raw;         ///< raw device words as EXR; empty for none
  std::string save_scene;  ///< where to write the scene as TOML; empty for none
  WaveFlags wave;          ///< rtl
  bool check = false;      ///< rtl: compares every tap with the model
  bool counters = false;   ///< cmodel: counts what no pixel depends on, too
  bool no_counters = false;  ///< cmodel: does not count for the JSON alone
  bool plain = false;      ///< golden, cmodel: the plain implementation instead of the fast one
  // Animation: names in `out` and `raw` contain a run of '#' for the frame number.
  std::optional<std::string> orbit;  ///< "A..B", degrees
  bool sequence = false;             ///< as in the scene's [sequence]
  std::optional<int> frames;
  std::optional<int> keep_memory;  ///< MiB of classified voxels; absent: scene::usual_store_bytes()
  std::string video;               ///< empty for none
  std::optional<double> rate;      ///< of the video, frames a second

  bool counts() const { return counters || (!common.json.empty() && !no_counters); }
};

void declare(Options& options, RenderArguments& to);

}  // namespace fastsplat::cli
