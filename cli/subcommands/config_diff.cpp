// SPDX-License-Identifier: Apache-2.0
// fastsplat config diff: the keys in which two configurations differ.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "cli/common.hpp"
#include "cli/config_flags.hpp"
#include "cli/config_json.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ConfigDiffArguments {
  Common common;
  std::string a, b;
};

void declare(Options& options, ConfigDiffArguments& to) {
  options.positional("A", to.a, "a name or a TOML file");
  options.values(driver::config_names);
  options.positional("B", to.b, "a name or a TOML file");
  options.values(driver::config_names);
  declare(options, to.common);
  options.example("fastsplat config diff small mine.toml", "every key that differs; exit 1 if there are any");
  options.example("fastsplat config diff base base --json -", "the same as JSON");
}

/// Differences that the device sees; names and descriptions do not count.
struct ConfigDiffResult {
  cmodel::Config a, b;
  std::vector<const cmodel::ConfigKey*> differ;
};

ConfigDiffResult compared(const cmodel::Config& a, const cmodel::Config& b) {
  ConfigDiffResult result{.a = a, .b = b, .differ = {}};
  for (const auto& key : cmodel::config_keys()) {
    if (a.*key.member != b.*key.member) result.differ.push_back(&key);
  }
  return result;
}

std::string identity(const cmodel::Config& config) {
  return config.name + " " + hash_text(cmodel::config_hash(config));
}

std::string to_text(const ConfigDiffResult& result) {
  if (result.differ.empty()) return fmt::format("equal: {} and {}\n", identity(result.a), identity(result.b));
  std::string text = fmt::format("{} and {} differ in {}\n", identity(result.a), identity(result.b),
                                 counted(result.differ.size(), "key"));
  for (const auto* key : result.differ) {
    text += fmt::format("  {:24}{:>8}{:>8}   {}\n", key->name, cmodel::text_of(result.a, *key),
                        cmodel::text_of(result.b, *key), key->meaning);
  }
  return text;
}

Json to_json(const ConfigDiffResult& result) {
  Json json{{"verb", "config diff"},
            {"equal", result.differ.empty()},
            {"a", config_identity_json(result.a)},
            {"b", config_identity_json(result.b)},
            {"differences", Json::array()}};
  for (const auto* key : result.differ)
    json["differences"].push_back(
        {{"key", key->name}, {"a", value_json(result.a, *key)}, {"b", value_json(result.b, *key)}});
  return json;
}

ExitCode run(const ConfigDiffArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json},
                 .inputs = joined(inputs_of_config(arguments.a), inputs_of_config(arguments.b))});
  const ConfigDiffResult result = compared(load(arguments.a, {}), load(arguments.b, {}));
  output.line(to_text(result));
  output.json(to_json(result));
  return result.differ.empty() ? ExitCode::Pass : ExitCode::Failed;
}

}  // namespace

const Subcommand subcommands::config_diff{
    "config diff", "list the keys that differ between two configurations; exit 1 if there are any",
    subcommand<ConfigDiffArguments, declare, run>};

}  // namespace fastsplat::cli
