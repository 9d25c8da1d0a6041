// What `render` was asked for: a still, or an animation where --orbit or --sequence is given.
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
  GaussianFlags gaussians;  ///< instead of a scene of a volume
  std::string engine = "golden";
  ConfigFlags config;
  std::vector<std::string> out;
  std::string raw;         ///< raw device words as EXR; empty for none
  std::string save_scene;  ///< where to write the scene as TOML; empty for none
  WaveFlags wave;          ///< rtl
  bool check = false;      ///< rtl: compares every tap with the model
  bool plain = false;      ///< golden, cmodel: drawn as it is written down, not the fast way
  // An animation; its names in `out` and `raw` hold a run of '#' for the frame's number.
  std::optional<std::string> orbit;  ///< "A..B", degrees
  bool sequence = false;             ///< as the scene's [sequence] says
  std::optional<int> frames;
  std::string video;           ///< empty for none
  std::optional<double> rate;  ///< of the video, frames a second
};

void declare(Options& options, RenderArguments& to);

}  // namespace fastsplat::cli
