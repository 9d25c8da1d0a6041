// SPDX-License-Identifier: Apache-2.0
// fastsplat config list: the configurations built into the program.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "cli/common.hpp"
#include "cli/config_json.hpp"
#include "cli/output.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

struct ConfigListArguments {
  Common common;
};

void declare(Options& options, ConfigListArguments& to) {
  declare(options, to.common);
  options.example("fastsplat config list", "names, hashes and purposes");
  options.example("fastsplat config list --json configs.json", "every key of all configurations as JSON");
}

std::string to_text(const std::vector<cmodel::Config>& configs) {
  std::string text;
  for (const auto& config : configs) {
    text += fmt::format("{:10} {}  {:2}x{:<2} lanes, {:4}x{:<4} tile  {}\n", config.name,
                        hash_text(cmodel::config_hash(config)), config.lanes, config.lanes, config.tile_width,
                        config.tile_height, config.description);
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<cmodel::Config>& configs) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& config : configs) json.push_back(config_json(config));
  return json;
}

ExitCode run(const ConfigListArguments& arguments) {
  const Output output(arguments.common);
  std::vector<cmodel::Config> configs;
  for (const auto& name : driver::config_names()) configs.push_back(driver::load_config(name));
  output.line(to_text(configs));
  output.json(to_json(configs));
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::config_list{"config list", "list the built-in configurations",
                                          subcommand<ConfigListArguments, declare, run>};

}  // namespace fastsplat::cli
