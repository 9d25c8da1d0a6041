#include "driver/config_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/hash_text.hpp"
#include "base/read_file.hpp"
#include "base/suggest.hpp"
#include "driver/builtin_configs.hpp"

namespace fastsplat::driver {
namespace {

std::string place(const std::string& file, const toml::source_region& source) {
  return fmt::format("{}:{}:{}", file, source.begin.line, source.begin.column);
}

std::vector<std::string> key_names() {
  std::vector<std::string> names{"name", "description", "verified"};
  for (const auto& key : cmodel::config_keys()) names.emplace_back(key.name);
  return names;
}

std::string text_value(const std::string& file, const toml::node& node, const std::string& key) {
  if (const auto value = node.value_exact<std::string>()) return *value;
  throw_input({.where = place(file, node.source()),
               .what = key + " is not text",
               .expected = "a string",
               .got = {},
               .fix = "write " + key + " = \"...\""});
}

/// A number or a word, as cmodel::set() takes it.
std::string value_text(const std::string& file, const toml::node& node, const cmodel::ConfigKey& key) {
  if (!key.names.empty()) return text_value(file, node, key.name);
  if (const auto value = node.value_exact<std::int64_t>()) return std::to_string(*value);
  throw_input({.where = place(file, node.source()),
               .what = fmt::format("{} is not a whole number", key.name),
               .expected = cmodel::allowed(key),
               .got = {},
               .fix = fmt::format("{} is {}", key.name, key.meaning)});
}

void take(const std::string& file, const toml::node& node, const std::string& name, cmodel::Config& config) {
  if (name == "name") {
    config.name = text_value(file, node, name);
  } else if (name == "description") {
    config.description = text_value(file, node, name);
  } else if (name == "verified") {
    config.verified = text_value(file, node, name);
  } else {
    const cmodel::ConfigKey* key = cmodel::find_key(name);
    if (key == nullptr) {
      throw_input({.where = place(file, node.source()),
                   .what = fmt::format("unknown key '{}'", name),
                   .expected = {},
                   .got = {},
                   .fix = suggestion(name, key_names())});
    }
    if (auto wrong = cmodel::set(config, name, value_text(file, node, *key))) {
      wrong->where = place(file, node.source());
      wrong->what = name + " " + wrong->what;
      throw_input(*wrong);
    }
  }
}

cmodel::Config parse(const std::string& file, const std::string& text) {
  toml::table root;
  try {
    root = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw_input({.where = place(file, error.source()),
                 .what = fmt::format("not valid TOML: {}", error.description()),
                 .expected = {},
                 .got = {},
                 .fix = "compare with the output of 'fastsplat config show base'"});
  }
  cmodel::Config config;
  std::vector<std::string> seen;
  for (const auto& [name, node] : root) {
    const std::string outer(name.str());
    if (const auto* table = node.as_table()) {
      for (const auto& [inner, value] : *table) {
        seen.push_back(outer + "." + std::string(inner.str()));
        take(file, value, seen.back(), config);
      }
    } else {
      seen.push_back(outer);
      take(file, node, outer, config);
    }
  }
  for (const auto& name : key_names()) {
    const cmodel::ConfigKey* key = cmodel::find_key(name);
    const bool optional = key != nullptr && key->neutral;
    if (!optional && std::find(seen.begin(), seen.end(), name) == seen.end()) {
      throw_input({.where = file,
                   .what = fmt::format("key '{}' is missing", name),
                   .expected = "every key",
                   .got = {},
                   .fix = "add it; 'fastsplat config show base' prints them all"});
    }
  }
  if (auto violation = cmodel::first_violation(config)) {
    violation->where = file + ": " + violation->where;
    throw_input(*violation);
  }
  return config;
}

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
  std::string table;
  for (const auto& key : cmodel::config_keys()) {
    const std::string name = key.name;
    const auto dot = name.find('.');
    if (name.substr(0, dot) != table) {
      table = name.substr(0, dot);
      text += fmt::format("\n[{}]\n", table);
    }
    const std::string value = cmodel::text_of(config, key);
    const bool neutral = key.neutral == config.*key.member;
    text += fmt::format(
        "{:40} # {}{}{}: {}\n",
        fmt::format("{}{} = {}", neutral ? "# " : "", name.substr(dot + 1), key.names.empty() ? value : quoted(value)),
        cmodel::allowed(key), key.power_of_two ? ", a power of two" : "", key.neutral ? ", may be absent" : "",
        key.meaning);
  }
  return text;
}

std::vector<std::string> config_names() {
  std::vector<std::string> names;
  for (const auto& builtin : builtin_configs()) names.emplace_back(builtin.name);
  return names;
}

cmodel::Config load_config(const std::string& name_or_path) {
  for (const auto& builtin : builtin_configs()) {
    if (name_or_path == builtin.name) return parse(fmt::format("configs/{}.toml", builtin.name), builtin.text);
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
  return parse(name_or_path, text.str());
}

}  // namespace fastsplat::driver
