// SPDX-License-Identifier: Apache-2.0
// Output shared by the subcommands of `errors`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/image.hpp"
#include "base/images/image_file.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"

namespace fastsplat::cli {

/// "ch2bet 181x217x181, ...; configuration base 025c7da2cf5f77b2\n"; `scene` is its summary.
std::string errors_heading(const std::string& scene, const cmodel::Config& config);
/// {"subcommand", "version", "scene", "config"}
nlohmann::ordered_json errors_identity(const char* subcommand, const std::string& scene, const cmodel::Config& config);

/// Writes a map with its legend as a display picture.
void write_map(const std::string& path, const Image& map);
/// Of values per pixel: identify scene, configuration and `what` ("errors", "bound").
images::Metadata values_metadata(const char* what, const scene::Scene& scene, const cmodel::Config& config);

}  // namespace fastsplat::cli
