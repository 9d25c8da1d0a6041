// SPDX-License-Identifier: Apache-2.0
// scene.toml: every key is optional; absent keys keep their defaults. The keys are those of scene/settings_list.cpp.
// This file adds the keys that are not plain settings: volume and transfer_function (relative to the file), nan_as,
// image.size for width and height, and kernel.name in place of a and radius. A table [sequence] (scene/sequence.cpp)
// must be valid but does not change the still.
#include "scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "scene/embedded.hpp"
#include "scene/open_scene.hpp"
#include "scene/sequence_table.hpp"
#include "scene/settings.hpp"
#include "scene/toml_reader.hpp"
#include "scene/volume/synthetic.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDemoPrefix = "demo:";

bool is_known_volume(const std::string& text) {
  const auto names = volume::known_volume_names();
  return std::find(names.begin(), names.end(), text.substr(0, text.find(':'))) != names.end();
}

bool is_preset(const std::string& text) {
  const auto names = transfer_function_presets();
  return std::find(names.begin(), names.end(), text) != names.end();
}

std::string anchored(const std::string& text, const fs::path& folder) {
  return fs::absolute(folder / text).lexically_normal().string();
}

void read_image(TomlTable& table, SceneDescription& d) {
  const auto size = table.integer("size", 1, kMaxImageSide);
  if (!size) return;
  for (const char* key : {"width", "height"}) {
    if (table.has(key)) table.refuse(key, "given twice", "either size, or width and height", {}, "remove one of them");
  }
  d.width = d.height = *size;
}

void read_kernel(TomlTable& table, SceneDescription& d) {
  const auto name = table.text("name");
  const bool shaped = table.has("a") || table.has("radius");
  if (name && !name->empty()) {
    if (shaped) table.refuse("name", "a kernel with both a name and a shape", {}, {}, "remove name, or a and radius");
    const auto names = kernel_names();
    if (std::find(names.begin(), names.end(), *name) == names.end())
      table.refuse("name", "unknown kernel", {}, "\"" + *name + "\"", suggestion(*name, names));
    d.kernel = *name;
  } else if (shaped) {
    d.kernel.clear();
  }
}

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (const unsigned char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += static_cast<char>(c);
    } else if (c < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", c);
    } else {
      out += static_cast<char>(c);
    }
  }
  return out + "\"";
}

}  // namespace

TomlTable open_scene(const fs::path& path) {
  const std::string text = path.string();
  if (!text.starts_with(kDemoPrefix)) return TomlTable::parse_file(path, TomlKind::Scene);
  const std::string name = text.substr(kDemoPrefix.size());
  for (const auto& demo : demos()) {
    if (demo.name == name) return TomlTable::parse(demo.text, text, TomlKind::Scene);
  }
  throw_usage({.where = {},
               .what = "unknown demo scene '" + name + "'",
               .expected = {},
               .got = {},
               .fix = suggestion(name, demo_names())});
}

std::vector<std::string> demo_names() {
  std::vector<std::string> names;
  for (const auto& demo : demos()) names.push_back(demo.name);
  return names;
}

namespace {

SceneFile read_scene(TomlTable root, const fs::path& folder) {
  SceneFile all;
  SceneDescription& d = all.description;
  std::vector<Given> given;
  if (const auto text = root.text("volume")) {
    if (text->empty())
      root.refuse("volume", "empty", "a volume's path or name", {}, "for example volume = \"shells:64\"");
    d.volume = is_known_volume(*text) ? *text : anchored(*text, folder);
    d.volume_place = root.where("volume");
  }
  d.nan_as = root.number("nan_as", -kLargestVoxel, kLargestVoxel);
  if (const auto text = root.text("transfer_function")) {
    d.transfer_function = text->empty() || is_preset(*text) ? *text : anchored(*text, folder);
    d.transfer_function_place = root.where("transfer_function");
    const bool file = fs::path(*text).has_parent_path() || fs::path(*text).extension() == ".toml";
    if (!text->empty() && !is_preset(*text) && !file) {
      root.refuse("transfer_function", "unknown preset", {}, "\"" + *text + "\"",
                  suggestion(*text, transfer_function_presets()));
    }
  }
  for (const std::string& name : setting_tables()) {
    if (name.empty()) {
      read_settings(root, name, d, given);
      if (!d.crop.everything()) d.crop_place = root.where("crop");
    } else if (auto table = root.table(name)) {
      read_settings(*table, name, d, given);
      if (name == "image") read_image(*table, d);
      if (name == "kernel") read_kernel(*table, d);
      table->finish();
    }
  }
  if (auto table = root.table("sequence")) all.sequence = read_sequence(*table, given);
  root.finish();
  all.idle = idle_of(given, d);
  if (all.sequence) all.idle = idle_of(all.idle, *all.sequence, d);
  return all;
}

}  // namespace

SceneFile read_scene_file(const fs::path& path) { return read_scene(open_scene(path), path.parent_path()); }

SceneFile parse_scene(const std::string& text, const std::string& source) {
  return read_scene(TomlTable::parse(text, source, TomlKind::Scene), {});
}

SceneDescription load_scene_file(const fs::path& path) {
  SceneFile file = read_scene_file(path);
  refuse_idle(file.idle, file.description);
  return file.description;
}

std::string to_toml(const SceneDescription& d) {
  const std::string volume = is_known_volume(d.volume) ? d.volume : anchored(d.volume, {});
  const std::string tf = d.transfer_function.empty() || is_preset(d.transfer_function)
                             ? d.transfer_function
                             : anchored(d.transfer_function, {});
  std::string text = fmt::format("volume = {}\ntransfer_function = {}\n", toml_string(volume), toml_string(tf));
  if (d.nan_as) text += fmt::format("nan_as = {}\n", number_as_toml(*d.nan_as));
  for (const std::string& table : setting_tables()) {
    if (!table.empty()) text += fmt::format("\n[{}]\n", table);
    const bool named = table == "kernel" && !d.kernel.empty();  // a name stands for a and radius
    if (named) text += fmt::format("name = {}\n", toml_string(d.kernel));
    for (const Setting& setting : settings()) {
      if (table != setting.table || named) continue;
      if (!at_default(setting, d) && refusal(Given{&setting}, d)) continue;
      text += fmt::format("{} = {}\n", setting.key, value_as_toml(setting, d));
    }
  }
  return text;
}

}  // namespace fastsplat::scene
