// SPDX-License-Identifier: Apache-2.0
#include "driver/config/config_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/hash_text.hpp"
#include "base/read_file.hpp"
#include "base/suggest.hpp"
#include "driver/config/builtin_configs.hpp"
#include "driver/config/config_text.hpp"

namespace fastsplat::driver {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    }
  }
  return out + "\"";
}

}  // namespace

std::string to_toml(const cmodel::Config& config) {
  std::string text =
      fmt::format("# hash {}\nname = {}\ndescription = {}\nverified = {}\n", hash_text(cmodel::config_hash(config)),
                  quoted(config.name), quoted(config.description), quoted(config.verified));
  // Grouped by table, so that later keys stand with the others of their table.
  std::vector<std::pair<std::string, std::string>> tables;
  for (const auto& key : cmodel::config_keys()) {
    const std::string name = key.name;
    const auto dot = name.find('.');
    const std::string table = name.substr(0, dot);
    auto lines = std::find_if(tables.begin(), tables.end(), [&](const auto& one) { return one.first == table; });
    if (lines == tables.end()) lines = tables.insert(lines, {table, ""});
    const std::string value = cmodel::text_of(config, key);
    const bool neutral = key.neutral == config.*key.member;
    lines->second += fmt::format(
        "{:40} # {}{}{}: {}\n",
        fmt::format("{}{} = {}", neutral ? "# " : "", name.substr(dot + 1), key.names.empty() ? value : quoted(value)),
        cmodel::allowed(key), key.power_of_two ? ", a power of two" : "", key.neutral ? ", optional" : "", key.meaning);
  }
  for (const auto& [table, lines] : tables) text += fmt::format("\n[{}]\n{}", table, lines);
  return text;
}

std::vector<std::string> config_names() {
  std::vector<std::string> names;
  for (const auto& builtin : builtin_configs())
    if (builtin.listed) names.emplace_back(builtin.name);
  return names;
}

cmodel::Config load_config(const std::string& name_or_path) {
  for (const auto& builtin : builtin_configs()) {
    if (name_or_path == builtin.name)
      return parse_config(fmt::format("configs/{}{}.toml", builtin.listed ? "" : "faults/", builtin.name),
                          builtin.text);
  }
  const std::filesystem::path path(name_or_path);
  const auto names = config_names();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw_input({.where = name_or_path,
                 .what = "is a directory",
                 .expected = "a configuration file or name",
                 .got = {},
                 .fix = suggestion(name_or_path, names)});
  }
  if (!std::filesystem::exists(path, ignored)) {
    throw_input({.where = name_or_path,
                 .what = "no such configuration",
                 .expected = "a built-in name or a .toml file",
                 .got = {},
                 .fix = suggestion(name_or_path, names)});
  }
  require_regular_file(path);
  std::ifstream in(path, std::ios::binary);
  constexpr std::uintmax_t kLargest = 1 << 20;
  if (std::filesystem::file_size(path, ignored) > kLargest) {
    throw_input({.where = name_or_path,
                 .what = "too large for a configuration",
                 .expected = "at most 1 MiB",
                 .got = {},
                 .fix = "name a configuration file"});
  }
  std::ostringstream text;
  text << in.rdbuf();
  return parse_config(name_or_path, text.str());
}

}  // namespace fastsplat::driver
