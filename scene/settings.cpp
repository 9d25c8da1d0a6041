// SPDX-License-Identifier: Apache-2.0
#include "scene/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/each.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/suggest.hpp"

namespace fastsplat::scene {
namespace {

int position(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

template <class Kind>
std::string expected_number(const Kind& kind) {
  return fmt::format("{} in {}..{}", std::is_same_v<Kind, Integer> ? "an integer" : "a number", kind.low, kind.high);
}

std::optional<glm::dvec3> triple_from(const std::string& text) {
  glm::dvec3 out;
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    const auto comma = i < 2 ? text.find(',', at) : text.size();
    if (comma == std::string::npos) return std::nullopt;
    const auto number = number_from(std::string_view(text).substr(at, comma - at));
    if (!number) return std::nullopt;
    out[i] = *number;
    at = comma + 1;
  }
  return out;
}

template <class Kind, class Value>
bool inside(const Kind& kind, const Value& value) {
  if constexpr (std::is_same_v<Kind, Triple>) {
    return inside(Real{kind.low, kind.high, nullptr}, value.x) && inside(Real{kind.low, kind.high, nullptr}, value.y) &&
           inside(Real{kind.low, kind.high, nullptr}, value.z);
  } else {
    return value >= kind.low && value <= kind.high;
  }
}

/// What a flag expects instead of `text`; empty if `text` is valid.
std::string expected_instead(const Setting& setting, const std::string& text) {
  const auto unless = [](bool fine, std::string expected) { return fine ? std::string{} : std::move(expected); };
  return std::visit(
      Each{
          [&](const Real& kind) {
            const auto value = number_from(text);
            return unless(value && inside(kind, *value), value ? expected_number(kind) : "a finite number");
          },
          [&](const Integer& kind) {
            const auto value = integer_from<int>(text);
            return unless(value && inside(kind, *value), expected_number(kind));
          },
          [&](const Triple& kind) {
            const auto value = triple_from(text);
            return unless(value && inside(kind, *value), "X,Y,Z, each " + expected_number(kind));
          },
          [&](const Box&) {
            return unless(box_from(text).has_value(),
                          "A..B,C..D,E..F, each from low to high: voxels from 0, or coordinates of 3-D Gaussians");
          },
          [&](const Switch&) { return unless(text == "on" || text == "off", "on or off"); },
          [&](const Choice& kind) {
            const auto& names = kind.names();
            return unless(position(names, text) >= 0,
                          fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back()));
          },
      },
      setting.value);
}

std::string toml_string(const char* text) { return fmt::format("\"{}\"", text); }

}  // namespace

std::string number_as_toml(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string dotted(const Setting& setting) {
  return *setting.table ? fmt::format("{}.{}", setting.table, setting.key) : setting.key;
}

bool at_default(const Setting& setting, const SceneDescription& description) {
  static const SceneDescription plain;
  return value_as_toml(setting, description) == value_as_toml(setting, plain);
}

std::vector<std::string> setting_tables() {
  std::vector<std::string> tables;
  for (const Setting& setting : settings()) {
    if (position(tables, setting.table) < 0) tables.emplace_back(setting.table);
  }
  return tables;
}

std::string problem_with(const Setting& setting, const std::string& text) {
  const std::string expected = expected_instead(setting, text);
  if (expected.empty()) return {};
  std::vector<std::string> names;
  if (const auto* choice = std::get_if<Choice>(&setting.value)) names = choice->names();
  if (std::holds_alternative<Switch>(setting.value)) names = {"on", "off"};
  std::string hint = did_you_mean(text, names);
  if (!hint.empty()) hint = "; " + hint;
  return fmt::format("expected {}, got '{}'{}", expected, text, hint);
}

void set_from_text(const Setting& setting, const std::string& text, SceneDescription& description) {
  assert(problem_with(setting, text).empty());
  std::visit(Each{
                 [&](const Real& kind) { kind.of(description) = *number_from(text); },
                 [&](const Integer& kind) { kind.of(description) = *integer_from<int>(text); },
                 [&](const Triple& kind) { kind.of(description) = *triple_from(text); },
                 [&](const Box& kind) { kind.of(description) = *box_from(text); },
                 [&](const Switch& kind) { kind.of(description) = text == "on"; },
                 [&](const Choice& kind) { kind.set(description, position(kind.names(), text)); },
             },
             setting.value);
}

void read_settings(TomlTable& table, const std::string& name, SceneDescription& description,
                   std::vector<Given>& given) {
  for (const Setting& setting : settings()) {
    if (name != setting.table) continue;
    const char* key = setting.key;
    std::visit(Each{
                   [&](const Real& kind) {
                     if (const auto value = table.number(key, kind.low, kind.high)) kind.of(description) = *value;
                   },
                   [&](const Integer& kind) {
                     if (const auto value = table.integer(key, kind.low, kind.high)) kind.of(description) = *value;
                   },
                   [&](const Triple& kind) {
                     if (const auto value = table.triple(key, kind.low, kind.high))
                       kind.of(description) = {(*value)[0], (*value)[1], (*value)[2]};
                   },
                   [&](const Box& kind) {
                     const auto value = table.text(key);
                     if (!value) return;
                     const auto box = box_from(*value);
                     if (!box) {
                       table.refuse(key, "not a box of voxels", "\"A..B,C..D,E..F\", voxels from 0",
                                    "\"" + *value + "\"", "both ends are included; \"\" keeps all voxels");
                     }
                     kind.of(description) = *box;
                   },
                   [&](const Switch& kind) {
                     if (const auto value = table.flag(key)) kind.of(description) = *value;
                   },
                   [&](const Choice& kind) {
                     const auto value = table.text(key);
                     if (!value) return;
                     const int at = position(kind.names(), *value);
                     if (at < 0)
                       table.refuse(key, "unknown name", {}, "\"" + *value + "\"", suggestion(*value, kind.names()));
                     kind.set(description, at);
                   },
               },
               setting.value);
    if (table.has(key) && !at_default(setting, description)) given.push_back({&setting, table.where(key)});
  }
}

std::string value_as_toml(const Setting& setting, const SceneDescription& description) {
  SceneDescription d = description;  // the list's accessors also write
  return std::visit(
      Each{
          [&](const Real& kind) { return number_as_toml(kind.of(d)); },
          [&](const Integer& kind) { return fmt::format("{}", kind.of(d)); },
          [&](const Triple& kind) {
            const glm::dvec3& v = kind.of(d);
            return fmt::format("[{}, {}, {}]", number_as_toml(v.x), number_as_toml(v.y), number_as_toml(v.z));
          },
          [&](const Box& kind) { return toml_string(to_string(kind.of(d)).c_str()); },
          [&](const Switch& kind) { return std::string(kind.of(d) ? "true" : "false"); },
          [&](const Choice& kind) { return toml_string(kind.names()[static_cast<std::size_t>(kind.get(d))].c_str()); },
      },
      setting.value);
}

void check_limits(const SceneDescription& description) {
  assert(description.shading >= -1 && description.shading <= 1);
  SceneDescription d = description;
  const auto check = [&d](const Setting& setting, const auto& kind) {
    if (inside(kind, kind.of(d))) return;
    throw_usage({.where = {},
                 .what = fmt::format("{}{}{} is out of range", setting.table, *setting.table ? " " : "", setting.key),
                 .expected = fmt::format("{}..{}", kind.low, kind.high),
                 .got = value_as_toml(setting, d),
                 .fix = "choose a value in this range"});
  };
  for (const Setting& setting : settings()) {
    std::visit(Each{
                   [&](const Real& kind) { check(setting, kind); },
                   [&](const Integer& kind) { check(setting, kind); },
                   [&](const Triple& kind) { check(setting, kind); },
                   [](const Box&) {},
                   [](const Switch&) {},
                   [](const Choice&) {},
               },
               setting.value);
  }
}

}  // namespace fastsplat::scene
