// SPDX-License-Identifier: Apache-2.0
// A value of a setting: for a flag or a configuration key in SPEC.toml, and in a row of results.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace fastsplat::plan {

using Value = std::variant<bool, std::int64_t, double, std::string>;

/// As on the command line: "true", "64", "0.5", "base"; a number's shortest text that reads back as itself.
std::string to_text(const Value& value);
nlohmann::ordered_json to_json(const Value& value);
/// Throws std::runtime_error unless it is a single value.
Value value_from(const nlohmann::ordered_json& json);

/// A setting by its name: a flag of a subcommand without its dashes ("size"), or a configuration key ("snap.phases").
struct Setting {
  std::string name;
  Value value;
  auto operator<=>(const Setting&) const = default;
};
using Settings = std::vector<Setting>;

/// Configuration keys contain a dot, flags never do.
inline bool is_key(std::string_view name) { return name.find('.') != std::string_view::npos; }

using Words = std::vector<std::string>;

/// The words, quoted for a shell.
std::string shell_line(const Words& words);

}  // namespace fastsplat::plan
