// fastsplat config show: a configuration as the TOML that gives it back.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "cli/common.hpp"
#include "cli/config_json.hpp"
#include "cli/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "driver/config_file.hpp"

namespace fastsplat::cli {
namespace {

struct Arguments {
  Common common;
  std::string config;
};

void declare(Options& options, Arguments& to) {
  options.positional("CONFIG", to.config, "a name or a TOML file");
  declare(options, to.common);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "\"";
}

/// TOML that load_config reads back to the same configuration, each key with its limits and meaning.
std::string to_toml(const cmodel::Config& config) {
  std::string text =
      fmt::format("# hash {}\nname = {}\ndescription = {}\nverified = {}\n", hash_text(cmodel::config_hash(config)),
                  quoted(config.name), quoted(config.description), quoted(config.verified));
  std::string table;
  for (const auto& key : cmodel::config_keys()) {
    const std::string name = key.name;
    const auto dot = name.find('.');
    if (name.substr(0, dot) != table) {
      table = name.substr(0, dot);
      text += fmt::format("\n[{}]\n", table);
    }
    const std::string value = cmodel::text_of(config, key);
    text += fmt::format("{:40} # {}{}{}: {}\n",
                        fmt::format("{} = {}", name.substr(dot + 1), key.names.empty() ? value : quoted(value)),
                        cmodel::allowed(key), key.power_of_two ? ", a power of two" : "",
                        key.neutral ? ", may be absent" : "", key.meaning);
  }
  return text;
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  const auto config = driver::load_config(arguments.config);
  output.line(to_toml(config));
  output.json(config_json(config));
  return ExitCode::Pass;
}

}  // namespace

const Verb verbs::config_show{"config show", "every key of one, as TOML that --config takes",
                              verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
