// fastsplat config list|show|check: hardware configurations.
#include "cmodel/config.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "driver/config_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string hash_of(const cmodel::Config& config) { return hash_text(cmodel::config_hash(config)); }

Json to_json(const cmodel::Config& config) {
  Json json{{"name", config.name},
            {"description", config.description},
            {"verified", config.verified},
            {"hash", hash_of(config)}};
  for (const auto& key : cmodel::config_keys()) {
    const std::string name = key.name;
    const auto dot = name.find('.');
    Json& value = json[name.substr(0, dot)][name.substr(dot + 1)];
    if (key.names.empty())
      value = config.*key.member;
    else
      value = cmodel::text_of(config, key);
  }
  return json;
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
  std::string text = fmt::format("# hash {}\nname = {}\ndescription = {}\nverified = {}\n", hash_of(config),
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

}  // namespace

ExitCode run(const ConfigListArguments& arguments) {
  const Output output(arguments.common);
  Json json = Json::array();
  for (const auto& name : driver::config_names()) {
    const auto config = driver::load_config(name);
    output.line(fmt::format("{:10} {}  {:2}x{:<2} lanes, {:4}x{:<4} tile  {}", name, hash_of(config), config.lanes,
                            config.lanes, config.tile_width, config.tile_height, config.description));
    json.push_back(to_json(config));
  }
  output.json(json.dump(2));
  return ExitCode::Pass;
}

ExitCode run(const ConfigShowArguments& arguments) {
  const Output output(arguments.common);
  const auto config = driver::load_config(arguments.config);
  output.line(to_toml(config));
  output.json(to_json(config).dump(2));
  return ExitCode::Pass;
}

ExitCode run(const ConfigCheckArguments& arguments) {
  const Output output(arguments.common);
  const auto config = driver::load_config(arguments.file);
  output.line(fmt::format("{}: sound; configuration {}, hash {}", arguments.file, config.name, hash_of(config)));
  output.json(to_json(config).dump(2));
  return ExitCode::Pass;
}

}  // namespace fastsplat::cli
