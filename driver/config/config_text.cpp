// SPDX-License-Identifier: Apache-2.0
#include "driver/config/config_text.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <vector>

#include "base/suggest.hpp"
#include "base/toml/toml_text.hpp"

namespace fastsplat::driver {
namespace {

std::string place(const std::string& file, const toml::source_region& source) { return place_in(file, source.begin); }

std::vector<std::string> key_names() {
  std::vector<std::string> names{"name", "description", "verified"};
  for (const auto& key : cmodel::config_keys()) names.emplace_back(key.name);
  return names;
}

std::string text_value(const std::string& file, const toml::node& node, const std::string& key) {
  if (const auto value = node.value_exact<std::string>()) return *value;
  throw_input({.where = place(file, node.source()),
               .what = key + " has the wrong type",
               .expected = "a string",
               .got = {},
               .fix = "write " + key + " = \"...\""});
}

/// The value as text for cmodel::set(): a whole number or a name.
std::string value_text(const std::string& file, const toml::node& node, const cmodel::ConfigKey& key) {
  if (!key.names.empty()) return text_value(file, node, key.name);
  if (const auto value = node.value_exact<std::int64_t>()) return std::to_string(*value);
  throw_input({.where = place(file, node.source()),
               .what = fmt::format("{} is not a whole number", key.name),
               .expected = cmodel::allowed(key),
               .got = {},
               .fix = fmt::format("{} is {}", key.name, key.meaning)});
}

/// Names are printed within lines of text.
void refuse_unspeakable(const std::string& file, const toml::node& node, const std::string& name) {
  const auto odd = std::find_if(name.begin(), name.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
  const bool blank = name.find_first_not_of(' ') == std::string::npos;
  if (!blank && odd == name.end()) return;
  throw_input({.where = place(file, node.source()),
               .what = "invalid name",
               .expected = "at least one visible character and no control characters",
               .got = blank ? "nothing" : fmt::format("character {:#04x}", static_cast<unsigned char>(*odd)),
               .fix = "for example name = \"mine\""});
}

void take(const std::string& file, const toml::node& node, const std::string& name, cmodel::Config& config) {
  if (name == "name") {
    config.name = text_value(file, node, name);
    refuse_unspeakable(file, node, config.name);
  } else if (name == "description") {
    config.description = text_value(file, node, name);
  } else if (name == "verified") {
    config.verified = text_value(file, node, name);
  } else {
    const cmodel::ConfigKey* key = cmodel::find_key(name);
    if (key == nullptr) {
      const std::string meant = did_you_mean(name, key_names());
      throw_input({.where = place(file, node.source()),
                   .what = fmt::format("unknown key '{}'", name),
                   .expected = {},
                   .got = {},
                   .fix = meant.empty() ? "'fastsplat config show base' prints all keys" : meant});
    }
    if (auto wrong = cmodel::set(config, name, value_text(file, node, *key))) {
      wrong->where = place(file, node.source());
      wrong->what = name + " " + wrong->what;
      throw_input(*wrong);
    }
  }
}

}  // namespace

cmodel::Config parse_config(const std::string& file, const std::string& text) {
  const toml::table root = parse_toml(text, file, TomlKind::Configuration);
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

}  // namespace fastsplat::driver
