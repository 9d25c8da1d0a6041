// SPDX-License-Identifier: Apache-2.0
#include "report/picture_names.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "base/lower_case.hpp"

namespace fastsplat::report {
namespace {

std::string text_at(const Json& json, const char* place) {
  const Json::json_pointer pointer(place);
  if (!json.contains(pointer) || !json.at(pointer).is_string()) return {};
  return json.at(pointer).get<std::string>();
}

/// Searches at the named place, then relative to the result's folder, then in it: results may be moved with their
/// pictures.
std::filesystem::path found(const Result& result, const std::string& name) {
  const std::filesystem::path named(name), folder = result.file.parent_path();
  std::error_code error;
  for (const auto& place : {named, folder / named, folder / named.filename()}) {
    if (std::filesystem::is_regular_file(place, error)) return place;
  }
  return named;
}

/// The most precise of a render's outputs; empty for none.
std::string best_of(const Json& json) {
  std::string best = text_at(json, "/raw");
  const auto outputs = json.find("outputs");
  if (!best.empty() || outputs == json.end() || !outputs->is_array()) return best;
  static constexpr std::array kOrder{".exr", ".tif", ".tiff", ".png"};
  std::size_t rank = kOrder.size();
  for (const Json& output : *outputs) {
    if (!output.is_string()) continue;
    const std::string ending = ending_of(output.get<std::string>());
    const auto at = static_cast<std::size_t>(std::find(kOrder.begin(), kOrder.end(), ending) - kOrder.begin());
    if (at >= rank) continue;
    rank = at;
    best = output.get<std::string>();
  }
  return best;
}

}  // namespace

std::string role_of_engine(const std::string& engine) {
  if (engine == "golden" || engine == "rtl") return engine;
  return engine == "cmodel" ? "integer" : "";
}

std::vector<NamedPicture> pictures_of(const Result& result) {
  std::vector<NamedPicture> pictures;
  const auto add = [&](const std::string& name, const std::string& role, const std::string& otherwise,
                       const std::string& tie = {}) {
    if (!name.empty())
      pictures.push_back({.role = role, .file = found(result, name), .otherwise = otherwise, .tie = tie});
  };
  if (result.subcommand == "compare") {
    add(text_at(result.json, "/ref/file"), "", "reference", "ref");
    add(text_at(result.json, "/test/file"), "", "test", "test");
  } else if (result.subcommand == "render") {
    add(best_of(result.json), role_of_engine(text_at(result.json, "/engine")), "picture");
  } else if (result.subcommand == "stream replay") {
    add(best_of(result.json), "integer", "integer");
  } else if (result.subcommand == "errors") {
    add(text_at(result.json, "/blame"), "blame", "blame");
  }
  return pictures;
}

NamedPicture picture_from(const std::string& text) {
  const auto equals = std::min(text.find('='), text.size());
  const std::string role = text.substr(0, equals), file = text.substr(std::min(equals + 1, text.size()));
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto in_role = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; };
  if (role.empty() || file.empty() || !is_letter(role[0]) || !std::all_of(role.begin(), role.end(), in_role)) {
    throw_usage({.where = "--picture",
                 .what = "not a role and a picture",
                 .expected = "ROLE=FILE with a role in lower case, such as golden, integer, rtl or blame",
                 .got = "'" + text + "'",
                 .fix = "for example --picture rtl=rtl.exr"});
  }
  return {.role = role, .file = file, .otherwise = role, .wanted = true};
}

}  // namespace fastsplat::report
