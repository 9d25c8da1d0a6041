// SPDX-License-Identifier: Apache-2.0
// What the page asks for: a scene and a configuration by the words of the command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "lab/gaussians.hpp"
#include "scene/capability.hpp"
#include "scene/scene.hpp"
#include "scene/settings.hpp"

namespace fastsplat::lab {

/// A setting that was asked for but has no effect on the scene, and why.
struct Idle {
  std::string setting;  ///< as scene::dotted
  std::string reason;
};

/// {"volume": "shells:64", "tf": "", "kernel": "gauss2", "settings": {"camera.azimuth": "30", ...},
///  "config": "base", "changes": ["radial.entries=256"]}; each key may be absent. Values are texts as flags take them.
/// "toml", a configuration file's text, stands in place of "config"; "gaussians", a name, in place of "volume".
struct Request {
  scene::SceneDescription scene;  ///< of Gaussians: camera and size
  std::optional<GaussianRequest> gaussians;
  cmodel::Config config;
  std::vector<Idle> idle;  ///< left out
};

/// Throws UserError about the first invalid value.
Request read_request(const nlohmann::ordered_json& json);

/// A setting's value as its flag takes it.
std::string flag_text(const scene::Setting& setting, const scene::SceneDescription& description);

/// `fastsplat render` with the flags that draw the same words; `golden_only`: those of the golden renderer. Files of
/// the page, in "/files", lose their folders; tf.toml and mine.toml stand for a transfer function and a configuration
/// of its own.
std::string command_line(const nlohmann::ordered_json& request, const Request& read, bool golden_only = false);

}  // namespace fastsplat::lab
