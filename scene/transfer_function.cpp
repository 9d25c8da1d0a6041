// SPDX-License-Identifier: Apache-2.0
// A transfer function file:
//
//   domain = "percentile"      # how `at` is read: "value", "range" (default), "percentile", "hounsfield" or "content"
//   reference_length = 1.0     # thickness to which `opacity` refers, kernel units (default 1); or reference_length_mm
//   points = [                 # ascending in `at`; linear between; two at the same place make a step
//     {at = 0.3, colour = [0.9, 0.7, 0.6], opacity = 0.0},
//     {at = 0.6, colour = [1.0, 0.9, 0.9], opacity = 0.7},
//   ]
//   [shading]                  # absent: off
//   on = true
//   ambient = 0.3              # and diffuse, specular (0..1), shininess (1..1000), gradient_floor (0..1)
#include "scene/transfer_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "scene/embedded.hpp"
#include "scene/toml_reader.hpp"

namespace fastsplat::scene {
namespace {

constexpr double kMaxOpacity = 0.9999;

const std::vector<std::string> kDomains{"value", "range", "percentile", "hounsfield", "content"};

Domain read_domain(TomlTable& table) {
  const std::string name = table.text("domain").value_or("range");
  const auto found = std::find(kDomains.begin(), kDomains.end(), name);
  if (found == kDomains.end())
    table.refuse("domain", "unknown domain", {}, "\"" + name + "\"", suggestion(name, kDomains));
  return static_cast<Domain>(found - kDomains.begin());
}

ControlPoint read_point(TomlTable& table, Domain domain) {
  constexpr double kValues = 1e30, kShares = 10.0;
  const auto at = table.number("at", -kValues, kValues);
  const bool shares = domain != Domain::Value && domain != Domain::Hounsfield;
  if (at && shares && std::abs(*at) > kShares) {
    table.refuse("at",
                 fmt::format("value out of range for domain = \"{}\"", kDomains[static_cast<std::size_t>(domain)]),
                 fmt::format("a number in {}..{}", -kShares, kShares), fmt::format("{}", *at),
                 "write domain = \"value\" for stored values, or domain = \"hounsfield\" for HU");
  }
  const auto colour = table.triple("colour", 0.0, 1.0);
  const auto opacity = table.number("opacity", 0.0, 1.0);
  table.finish();
  for (const auto& [key, present] :
       {std::pair{"at", at.has_value()}, {"colour", colour.has_value()}, {"opacity", opacity.has_value()}}) {
    if (!present)
      table.refuse(key, "missing", "at, colour and opacity", {},
                   "write for example {at = 0.5, colour = [1, 1, 1], opacity = 0.2}");
  }
  return {.at = *at, .colour = {(*colour)[0], (*colour)[1], (*colour)[2]}, .opacity = std::min(*opacity, kMaxOpacity)};
}

Shading read_shading(TomlTable& table) {
  Shading shading;
  shading.on = table.flag("on").value_or(true);
  shading.ambient = table.number("ambient", 0.0, 1.0).value_or(shading.ambient);
  shading.diffuse = table.number("diffuse", 0.0, 1.0).value_or(shading.diffuse);
  shading.specular = table.number("specular", 0.0, 1.0).value_or(shading.specular);
  shading.shininess = table.number("shininess", 1.0, 1000.0).value_or(shading.shininess);
  shading.gradient_floor = table.number("gradient_floor", 0.0, 1.0).value_or(shading.gradient_floor);
  table.finish();
  return shading;
}

TransferFunction read(TomlTable table, const std::string& name) {
  TransferFunction tf;
  tf.name = name;
  tf.domain = read_domain(table);
  tf.reference_length = table.number("reference_length", 1e-3, 1e3).value_or(1.0);
  tf.reference_length_mm = table.number("reference_length_mm", 1e-6, 1e6);
  if (tf.reference_length_mm && tf.reference_length != 1.0)
    table.refuse("reference_length_mm", "two reference lengths are given", "one of them", {},
                 "remove reference_length");
  for (TomlTable& point : table.tables("points")) {
    tf.points.push_back(read_point(point, tf.domain));
    if (tf.points.size() > 1 && tf.points.back().at < tf.points[tf.points.size() - 2].at) {
      point.refuse("at", "the points are not in ascending order",
                   fmt::format("at least {}", tf.points[tf.points.size() - 2].at),
                   fmt::format("{}", tf.points.back().at), "sort the points by `at`");
    }
  }
  if (auto shading = table.table("shading")) tf.shading = read_shading(*shading);
  table.finish();
  if (tf.points.empty()) {
    table.refuse("points", "missing or empty", "at least one point", {},
                 "write points = [{at = 0.5, colour = [1, 1, 1], opacity = 0.2}]");
  }
  return tf;
}

}  // namespace

TransferFunction load_transfer_function(const std::string& name_or_path) {
  for (const auto& preset : presets()) {
    if (preset.name == name_or_path)
      return read(TomlTable::parse(preset.text, "preset " + preset.name, TomlKind::TransferFunction), preset.name);
  }
  const std::filesystem::path path = name_or_path;
  std::error_code error;
  const bool looks_like_path =
      path.has_parent_path() || path.extension() == ".toml" || std::filesystem::is_regular_file(path, error);
  if (!looks_like_path) {
    throw_input({.where = {},
                 .what = "unknown transfer function '" + name_or_path + "'",
                 .expected = {},
                 .got = {},
                 .fix = suggestion(name_or_path, transfer_function_presets())});
  }
  return read(TomlTable::parse_file(path, TomlKind::TransferFunction), name_or_path);
}

std::vector<std::string> transfer_function_presets() {
  std::vector<std::string> names;
  for (const auto& preset : presets()) names.push_back(preset.name);
  return names;
}

}  // namespace fastsplat::scene
