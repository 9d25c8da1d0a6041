// SPDX-License-Identifier: Apache-2.0
// fastsplat config check: whether a configuration is valid and whether RTL can be built from it.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "cli/common.hpp"
#include "cli/config_flags.hpp"
#include "cli/config_json.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

struct ConfigCheckArguments {
  Common common;
  std::string file;
  std::vector<std::string> changes;
};

void declare(Options& options, ConfigCheckArguments& to) {
  options.positional("FILE", to.file, "a TOML file (or a name)");
  options.values(driver::config_names);
  options.group("Configuration");
  declare_changes(options, to.changes);
  declare(options, to.common);
  options.example("fastsplat config check mine.toml", "check a configuration, and whether RTL can be built from it");
  options.example("fastsplat config check base --set array.lanes=16", "check a change");
}

ExitCode run(const ConfigCheckArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}, .inputs = inputs_of_config(arguments.file)});
  const auto config = load(arguments.file, arguments.changes);
  output.line(fmt::format("{}: valid; configuration {}, hash {}", arguments.file, config.name,
                          hash_text(cmodel::config_hash(config))));
  auto json = config_json(config);
  const auto wrong = cmodel::rtl_violation(config);
  json["rtl"] = !wrong;
  if (wrong) {
    // Without the fix, which repeats that the model supports it.
    const auto why = one_line({wrong->where, wrong->what, wrong->expected, wrong->got, {}});
    output.line("for the model only, no RTL can be built from it: " + why);
    json["no_rtl"] = why;
  }
  output.json(json);
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::config_check{"config check",
                                           "check that every key is present, known and within its limits",
                                           subcommand<ConfigCheckArguments, declare, run>};

}  // namespace fastsplat::cli
