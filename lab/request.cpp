// SPDX-License-Identifier: Apache-2.0
#include "lab/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/shell_word.hpp"
#include "base/suggest.hpp"
#include "driver/config/changed.hpp"
#include "driver/config/config_file.hpp"
#include "driver/config/config_text.hpp"

namespace fastsplat::lab {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json, const char* key, const std::string& otherwise) {
  const auto found = json.find(key);
  return found == json.end() ? otherwise : found->get<std::string>();
}

const scene::Setting& setting_named(const std::string& name) {
  const auto all = scene::settings();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return scene::dotted(one) == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const auto& one : all) names.push_back(scene::dotted(one));
  throw_usage({.where = name, .what = "unknown setting", .expected = {}, .got = {}, .fix = suggestion(name, names)});
}

bool is_idle(const Request& read, const std::string& name) {
  return std::ranges::any_of(read.idle, [&](const Idle& one) { return one.setting == name; });
}

constexpr std::string_view kFiles = "/files/";

/// A name as the command has it. Each drop of files has a folder of its own.
std::string outside(const std::string& path) {
  return path.starts_with(kFiles) ? std::filesystem::path(path).filename().string() : path;
}

bool shapes_kernel(const std::string& setting) { return setting == "kernel.a" || setting == "kernel.radius"; }

scene::SceneDescription described(const Json& json, std::vector<scene::Given>& given) {
  scene::SceneDescription to;
  to.volume = text_of(json, "volume", to.volume);
  to.transfer_function = text_of(json, "tf", "");
  to.kernel = text_of(json, "kernel", to.kernel);
  const Json settings = json.value("settings", Json::object());
  for (const auto& [name, value] : settings.items()) {
    if (is_of_gaussians(name)) continue;
    const scene::Setting& setting = setting_named(name);
    const auto text = value.get<std::string>();
    if (const auto problem = scene::problem_with(setting, text); !problem.empty())
      throw_usage({.where = name, .what = problem, .expected = {}, .got = {}, .fix = {}});
    if (shapes_kernel(name) && !to.kernel.empty()) {  // one of the two alone keeps the other of the named kernel
      const auto named = scene::kernel_by_name(to.kernel);
      to.kernel_a = named.a();
      to.kernel_radius = named.radius();
      to.kernel.clear();
    }
    scene::set_from_text(setting, text, to);
    given.push_back({&setting});
  }
  return to;
}

/// The request without settings that have no effect on what it draws, which `idle` receives.
Json only_of_its_kind(Json json, bool gaussians, std::vector<Idle>& idle) {
  Json kept = Json::object();
  const Json settings = json.value("settings", Json::object());
  for (const auto& [name, value] : settings.items()) {
    const std::string reason = gaussians && !is_of_gaussians(name)   ? idle_for_gaussians(name)
                               : !gaussians && is_of_gaussians(name) ? "has no effect without 3-D Gaussians"
                                                                     : "";
    if (reason.empty())
      kept[name] = value;
    else
      idle.push_back({name, reason});
  }
  json["settings"] = kept;
  return json;
}

/// Transfer function and kernel.
std::string volume_flags(const scene::SceneDescription& d) {
  std::string flags;
  const bool own = d.transfer_function.starts_with(kFiles);
  if (!d.transfer_function.empty()) flags += " --tf " + (own ? "tf.toml" : shell_word(d.transfer_function));
  // Both halves of a shape: the program would take a missing one from its default kernel.
  if (d.kernel.empty())
    flags += fmt::format(" --kernel-a {} --kernel-radius {}", d.kernel_a, d.kernel_radius);
  else if (d.kernel != scene::SceneDescription{}.kernel)
    flags += " --kernel " + shell_word(d.kernel);
  return flags;
}

}  // namespace

Request read_request(const Json& whole) {
  Request out;
  const std::string gaussians = text_of(whole, "gaussians", "");
  const Json json = only_of_its_kind(whole, !gaussians.empty(), out.idle);
  std::vector<scene::Given> given;
  out.scene = described(json, given);
  // A setting may make another one idle, so one goes at a time.
  while (true) {
    const auto idle = scene::idle_of(given, out.scene);
    if (idle.empty()) break;
    const scene::Given& first = idle.front();
    out.idle.push_back({scene::dotted(*first.setting), one_line(*scene::refusal(first, out.scene))});
    std::erase_if(given, [&](const auto& one) { return one.setting == first.setting; });
    Json less = json;
    Json settings = Json::object();
    for (const auto& one : given) settings[scene::dotted(*one.setting)] = json["settings"][scene::dotted(*one.setting)];
    less["settings"] = settings;
    std::vector<scene::Given> same;
    out.scene = described(less, same);
  }
  if (!gaussians.empty()) out.gaussians = gaussian_request(gaussians, json["settings"], out.scene);
  const std::string toml = text_of(json, "toml", "");
  out.config =
      toml.empty() ? driver::load_config(text_of(json, "config", "base")) : driver::parse_config("configuration", toml);
  out.config = driver::changed(out.config, json.value("changes", std::vector<std::string>{}));
  return out;
}

std::string flag_text(const scene::Setting& setting, const scene::SceneDescription& description) {
  std::string text = scene::value_as_toml(setting, description);
  if (std::holds_alternative<scene::Switch>(setting.value)) return text == "true" ? "on" : "off";
  std::erase_if(text, [](char c) { return c == '"' || c == '[' || c == ']' || c == ' '; });
  return text;
}

std::string command_line(const Json& request, const Request& read, bool golden_only) {
  const scene::SceneDescription& d = read.scene;
  std::string line = "fastsplat render ";
  line += read.gaussians ? "--gaussians " + shell_word(outside(read.gaussians->name)) + read.gaussians->flags
                         : "--volume " + shell_word(outside(d.volume));
  if (!read.gaussians) line += volume_flags(d);
  line += d.width == d.height ? fmt::format(" --size {}", d.width) : fmt::format(" --size {}x{}", d.width, d.height);
  const Json settings = request.value("settings", Json::object());
  for (const auto& [name, value] : settings.items()) {
    if (is_of_gaussians(name) || is_idle(read, name)) continue;
    const auto& setting = setting_named(name);
    if (scene::at_default(setting, d) || shapes_kernel(name)) continue;
    if (name == "camera.projection" && !read.gaussians) line += " --perspective";
    if (*setting.flag != '\0') line += fmt::format(" {} {}", setting.flag, shell_word(value.get<std::string>()));
  }
  if (golden_only) return line + " --engine golden --out golden.exr";
  line += " --engine cmodel --config " +
          shell_word(text_of(request, "toml", "").empty() ? text_of(request, "config", "base") : "mine.toml");
  for (const auto& change : request.value("changes", std::vector<std::string>{}))
    line += " --set " + shell_word(change);
  return line + " --out device.exr";
}

}  // namespace fastsplat::lab
