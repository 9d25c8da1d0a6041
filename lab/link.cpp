// SPDX-License-Identifier: Apache-2.0
#include "lab/link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/percent.hpp"
#include "cmodel/numbers/config.hpp"
#include "lab/limits.hpp"
#include "lab/request.hpp"
#include "scene/scene_file.hpp"
#include "scene/settings.hpp"
#include "scene/volume/synthetic.hpp"

namespace fastsplat::lab {
namespace {

using Json = nlohmann::ordered_json;
using Query = std::map<std::string, std::string>;

constexpr std::string_view kPrefix = "#lab?";

/// A word of a query as a browser decodes it.
std::string decoded(std::string_view text) {
  std::string spaced(text);
  std::replace(spaced.begin(), spaced.end(), '+', ' ');
  return percent_decoded(spaced);
}

Query query_of(std::string_view text) {
  Query words;
  while (!text.empty()) {
    const auto one = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), one.size() + 1));
    const auto equals = std::min(one.find('='), one.size());
    words.emplace(decoded(one.substr(0, equals)), decoded(one.substr(std::min(one.size(), equals + 1))));
  }
  return words;
}

/// What the state does not follow: unknown words, and a size that is not one or not within the limits.
Json ignored_of(const Query& words, const Json& state) {
  std::set<std::string> known{"scene",  "volume",      "gaussians", "tf",   "tf_toml", "kernel",
                              "config", "config_hash", "toml",      "size", "view"};
  for (const scene::Setting& setting : scene::settings()) known.insert("s." + scene::dotted(setting));
  for (const auto& setting : gaussian_settings()) known.insert("s." + setting.at("name").get<std::string>());
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) known.insert("k." + std::string(key.name));
  Json ignored = Json::array();
  for (const auto& [name, value] : words) {
    const bool other_size =
        name == "size" && value != fmt::format("{}x{}", state["width"].get<int>(), state["height"].get<int>());
    if (other_size || (!name.empty() && !known.contains(name))) ignored.push_back((name + "=" + value).substr(0, 80));
  }
  return ignored;
}

bool is_built_in(const std::string& volume) {
  const auto names = volume::synthetic_names();
  return std::find(names.begin(), names.end(), volume.substr(0, volume.find(':'))) != names.end();
}

void take_scene(const std::string& text, Json& state) {
  const scene::SceneDescription scene = scene::parse_scene(text, "scene").description;
  // The page has files of its own only, without their folders.
  state["volume"] =
      is_built_in(scene.volume) ? scene.volume : "/files/" + std::filesystem::path(scene.volume).filename().string();
  state["tf"] = scene.transfer_function;
  if (!scene.kernel.empty()) state["kernel"] = scene.kernel;
  state["width"] = scene.width, state["height"] = scene.height;
  for (const scene::Setting& setting : scene::settings()) {
    const std::string table = setting.table;
    if (table == "image" || (table == "kernel" && !scene.kernel.empty()) || scene::at_default(setting, scene)) continue;
    state["settings"][scene::dotted(setting)] = flag_text(setting, scene);
  }
}

/// "tiny+radial.entries=64", the name of a changed configuration.
void take_config(const std::string& name, Json& state) {
  auto plus = std::min(name.find('+'), name.size());
  state["config"] = name.substr(0, plus);
  while (plus < name.size()) {
    const auto next = std::min(name.find('+', plus + 1), name.size());
    const std::string change = name.substr(plus + 1, next - plus - 1);
    const auto equals = change.find('=');
    if (equals != std::string::npos) state["changes"][change.substr(0, equals)] = change.substr(equals + 1);
    plus = next;
  }
}

void take_size(const std::string& text, Json& state) {
  const auto cross = std::min(text.find('x'), text.size());
  const auto width = integer_from<int>(std::string_view(text).substr(0, cross));
  const auto height = integer_from<int>(std::string_view(text).substr(std::min(text.size(), cross + 1)));
  if (width && height) state["width"] = *width, state["height"] = *height;
}

}  // namespace

Json state_of_link(const std::string& link) {
  Json state{{"volume", scene::SceneDescription{}.volume},
             {"gaussians", ""},
             {"tf", ""},
             {"tf_toml", ""},
             {"kernel", scene::SceneDescription{}.kernel},
             {"width", 256},
             {"height", 256},
             {"settings", Json::object()},
             {"config", "base"},
             {"toml", ""},
             {"changes", Json::object()}};
  if (link.empty()) return state;
  const auto at = link.find(kPrefix);
  if (at == std::string::npos) {
    throw_usage({.where = "link",
                 .what = "not an address of the lab",
                 .expected = "#lab?volume=...",
                 .got = "'" + link + "'",
                 .fix = "copy it with the page's button \"Copy link\", and quote it for the shell"});
  }
  const Query words = query_of(std::string_view(link).substr(at + kPrefix.size()));
  if (const auto scene = words.find("scene"); scene != words.end()) take_scene(scene->second, state);
  for (const char* name : {"volume", "gaussians", "tf", "tf_toml", "kernel", "toml"}) {
    if (const auto found = words.find(name); found != words.end()) state[name] = found->second;
  }
  if (const auto config = words.find("config"); config != words.end()) take_config(config->second, state);
  if (const auto size = words.find("size"); size != words.end()) take_size(size->second, state);
  for (const char* side : {"width", "height"}) state[side] = std::clamp(state[side].get<int>(), kLeastSide, kMostSide);
  for (const scene::Setting& setting : scene::settings()) {
    const std::string name = scene::dotted(setting);
    if (const auto found = words.find("s." + name); found != words.end()) state["settings"][name] = found->second;
  }
  for (const auto& setting : gaussian_settings()) {
    const std::string name = setting.at("name");
    if (const auto found = words.find("s." + name); found != words.end()) state["settings"][name] = found->second;
  }
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
    if (const auto found = words.find("k." + std::string(key.name)); found != words.end())
      state["changes"][key.name] = found->second;
  }
  if (Json ignored = ignored_of(words, state); !ignored.empty()) state["ignored"] = std::move(ignored);
  return state;
}

std::string link_of_gaussians(const scene::GaussianScene& scene) {
  const scene::GaussianDescription& description = scene.description;
  if (description.placed || description.near || description.order || scene.cloud->cropped) return {};
  const bool built_in = scene.cloud->source.starts_with("built-in ");
  const scene::CameraParams& camera = description.camera;
  return fmt::format(
      "gaussians={}&size={}x{}&s.camera.projection={}&s.camera.azimuth={}&s.camera.elevation={}&s.camera.roll={}"
      "&s.camera.zoom={}&s.camera.fov={}&s.gaussians.up={}&s.gaussians.low_pass={}&s.gaussians.cutoff={}",
      percent_encoded((built_in ? "" : "/files/") + scene.cloud->name), description.width, description.height,
      camera.projection == scene::Projection::Perspective ? "perspective" : "orthographic", camera.azimuth,
      camera.elevation, camera.roll, camera.zoom, camera.fov,
      scene::up_axis_names()[static_cast<std::size_t>(description.up)], description.low_pass, description.cutoff);
}

Json request_of_state(const Json& state) {
  Json request{{"ask", "frame"}};
  for (const char* name : {"volume", "gaussians", "kernel", "settings", "config"}) request[name] = state.at(name);
  request["tf"] = state.at("tf_toml").get<std::string>().empty() ? state.at("tf") : Json("/files/tf.toml");
  if (!state.at("toml").get<std::string>().empty()) request["toml"] = state.at("toml");
  for (const char* side : {"width", "height"})
    request["settings"][fmt::format("image.{}", side)] = std::to_string(state.at(side).get<int>());
  request["changes"] = Json::array();
  for (const auto& [key, value] : state.at("changes").items())
    request["changes"].push_back(key + "=" + value.get<std::string>());
  return request;
}

}  // namespace fastsplat::lab
