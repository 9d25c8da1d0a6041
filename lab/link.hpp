// SPDX-License-Identifier: Apache-2.0
// The page's address: everything behind "#lab?" as a scene and a device, and as the program's command line.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "scene/gaussians/gaussian_scene.hpp"

namespace fastsplat::lab {

/// What the page shows: {"volume", "gaussians", "tf", "tf_toml", "kernel", "width", "height", "settings": {NAME: text},
/// "config", "toml", "changes": {KEY: text}}. `link`: an address or its part from "#" on,
/// "volume=...&config=...&size=WxH&s.SETTING=...& k.KEY=..."; "scene=TEXT", a scene.toml, stands in place of volume and
/// settings, and a changed configuration's name, "tiny+radial.entries=64", in place of config and changes. Absent words
/// keep their defaults; "ignored" lists unknown ones and a size outside the limits, if any. Throws UserError (Usage)
/// for other addresses.
nlohmann::ordered_json state_of_link(const std::string& link);

/// The part behind "#lab?" of a link to a view of 3-D Gaussians; empty for views that the page does not have.
std::string link_of_gaussians(const scene::GaussianScene& scene);

/// The request "frame" for a state. A transfer function of its own is "tf.toml".
nlohmann::ordered_json request_of_state(const nlohmann::ordered_json& state);

}  // namespace fastsplat::lab
