// SPDX-License-Identifier: Apache-2.0
#include "cli/errors_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/config_json.hpp"

namespace fastsplat::cli {

std::string errors_heading(const std::string& scene, const cmodel::Config& config) {
  return fmt::format("{}; configuration {} {}\n", scene, config.name, hash_text(cmodel::config_hash(config)));
}

nlohmann::ordered_json errors_identity(const char* subcommand, const std::string& scene, const cmodel::Config& config) {
  return {
      {"verb", subcommand}, {"version", program_version()}, {"scene", scene}, {"config", priced_config_json(config)}};
}

void write_map(const std::string& path, const Image& map) {
  images::write_image(path, map, {{"display", "srgb"}}, {.display = true});
}

images::Metadata values_metadata(const char* what, const scene::Scene& scene, const cmodel::Config& config) {
  return analysis::render_metadata(what, scene, analysis::HardwareConfig{config.name, cmodel::config_hash(config)});
}

}  // namespace fastsplat::cli
