// SPDX-License-Identifier: Apache-2.0
// fastsplat config show: a configuration as TOML that reproduces it.
#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/config_flags.hpp"
#include "cli/config_json.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

struct ConfigShowArguments {
  Common common;
  std::string config;
  std::vector<std::string> changes;
};

void declare(Options& options, ConfigShowArguments& to) {
  options.positional("CONFIG", to.config, "a name or a TOML file");
  options.values(driver::config_names);
  options.group("Configuration");
  declare_changes(options, to.changes);
  declare(options, to.common);
  options.example("fastsplat config show small > mine.toml", "a configuration to edit, every key with its limits");
  options.example("fastsplat config show tiny --set radial.entries=128", "a configuration with one key changed");
}

ExitCode run(const ConfigShowArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}, .inputs = inputs_of_config(arguments.config)});
  const auto config = load(arguments.config, arguments.changes);
  output.line(driver::to_toml(config));
  output.json(config_json(config));
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::config_show{"config show", "print every key of a configuration as TOML for --config",
                                          subcommand<ConfigShowArguments, declare, run>};

}  // namespace fastsplat::cli
