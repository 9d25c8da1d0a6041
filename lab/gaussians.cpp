// SPDX-License-Identifier: Apache-2.0
#include "lab/gaussians.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/shell_word.hpp"
#include "golden/gaussians.hpp"
#include "lab/limits.hpp"
#include "scene/gaussians/gaussian_file.hpp"

namespace fastsplat::lab {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kUp = "gaussians.up";
constexpr const char* kDeclared = "as declared";
constexpr std::array kCameras{"camera.azimuth", "camera.elevation",  "camera.roll", "camera.zoom",
                              "camera.fov",     "camera.projection", "image.width", "image.height"};

/// A setting that is a number.
struct Number {
  const char* name;
  const char* flag;
  const char* help;
  scene::Limits limits;
  double scene::GaussianDescription::*of;
};
constexpr std::array kNumbers{
    Number{"gaussians.low_pass", "--low-pass", "variance added to every footprint, in square pixels",
           scene::kLowPassLimits, &scene::GaussianDescription::low_pass},
    Number{"gaussians.cutoff", "--cutoff", "radius of a footprint in standard deviations", scene::kCutoffLimits,
           &scene::GaussianDescription::cutoff}};

[[noreturn]] void too_large(const std::string& name, const std::string& most, const std::string& got) {
  throw_usage({.where = name, .what = "too large for a page", .expected = most, .got = got, .fix = "use the program"});
}

void check_size(const std::string& name) {
  for (const auto& path : scene::files_of_gaussians(name)) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    if (!error && bytes > std::uintmax_t{kMostFileBytes})
      too_large(name, fmt::format("at most {} bytes", kMostFileBytes), fmt::format("{}", bytes));
  }
  const auto colon = name.find(':');
  const auto count = colon == std::string::npos ? std::nullopt : integer_from<std::int64_t>(name.substr(colon + 1));
  if (count && *count > kMostGaussians)
    too_large(name, fmt::format("at most {} Gaussians", kMostGaussians), fmt::format("{}", *count));
}

}  // namespace

Json gaussian_settings() {
  Json up{{"name", kUp},
          {"flag", "--up"},
          {"group", "3-D Gaussians"},
          {"unit", ""},
          {"help", "axis that points up"},
          {"default", kDeclared},
          {"kind", "choice"},
          {"choices", {kDeclared}}};
  for (const auto& axis : scene::up_axis_names()) up["choices"].push_back(axis);
  Json out = Json::array({up});
  for (const Number& one : kNumbers) {
    out.push_back({{"name", one.name},
                   {"flag", one.flag},
                   {"group", "3-D Gaussians"},
                   {"unit", ""},
                   {"help", one.help},
                   {"default", fmt::format("{}", scene::GaussianDescription{}.*one.of)},
                   {"kind", "real"},
                   {"low", one.limits.low},
                   {"high", one.limits.high}});
  }
  return out;
}

std::string idle_for_gaussians(const std::string& setting) {
  const bool ours = std::find(kCameras.begin(), kCameras.end(), setting) != kCameras.end();
  return ours ? "" : "has no effect on 3-D Gaussians";
}

bool is_of_gaussians(const std::string& setting) { return setting.starts_with("gaussians."); }

GaussianRequest gaussian_request(const std::string& name, const Json& settings, const scene::SceneDescription& scene) {
  GaussianRequest out{.name = name, .description = {}, .flags = {}};
  out.description.camera = scene.camera;
  out.description.width = scene.width, out.description.height = scene.height;
  if (scene.camera.projection == scene::Projection::Orthographic) out.flags += " --orthographic";
  const auto& axes = scene::up_axis_names();
  for (const auto& setting : settings.items()) {
    const std::string& key = setting.key();
    if (!is_of_gaussians(key)) continue;
    const auto text = setting.value().get<std::string>();
    if (key == kUp) {
      if (text == kDeclared) continue;
      const auto axis = std::find(axes.begin(), axes.end(), text);
      if (axis == axes.end())
        throw_usage({.where = key, .what = "unknown axis", .expected = {}, .got = "'" + text + "'", .fix = {}});
      out.description.up = static_cast<scene::UpAxis>(axis - axes.begin());
      out.up_given = true;
      out.flags += " --up " + text;
      continue;
    }
    const auto number =
        std::find_if(kNumbers.begin(), kNumbers.end(), [&](const Number& one) { return key == one.name; });
    if (number == kNumbers.end())
      throw_usage({.where = key, .what = "unknown setting", .expected = {}, .got = {}, .fix = {}});
    const auto given = number_from(text);
    if (!given)
      throw_usage({.where = key, .what = "expected a number", .expected = {}, .got = "'" + text + "'", .fix = {}});
    if (*given == scene::GaussianDescription{}.*number->of) continue;
    out.description.*number->of = *given;
    out.flags += fmt::format(" {} {}", number->flag, shell_word(text));
  }
  return out;
}

const GaussianView& GaussianViews::of(const GaussianRequest& request) {
  if (name_ != request.name || !cloud_) {
    check_size(request.name);
    name_.clear();
    cloud_.reset();
    view_.reset();
    cloud_ = std::make_shared<scene::GaussianCloud>(scene::load_gaussians(request.name));
    name_ = request.name;
  }
  scene::GaussianDescription view = request.description;
  if (!request.up_given) view.up = cloud_->up.value_or(scene::usual_up(request.name));
  const auto& camera = view.camera;
  const std::string key = fmt::format("{} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(camera.projection),
                                      camera.azimuth, camera.elevation, camera.roll, camera.zoom, camera.fov,
                                      view.width, view.height, static_cast<int>(view.up), view.low_pass, view.cutoff);
  if (view_ && view_->key == key) return *view_;
  view_.reset();
  GaussianView next{.key = key, .scene = scene::build_gaussian_scene(view, cloud_), .projected = {}, .golden = {}};
  next.projected = scene::project_all(next.scene);
  next.golden = golden::render_gaussians(next.scene, next.projected, {.threads = 1});
  return view_.emplace(std::move(next));
}

}  // namespace fastsplat::lab
