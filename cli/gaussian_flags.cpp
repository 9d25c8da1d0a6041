// SPDX-License-Identifier: Apache-2.0
#include "cli/gaussian_flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"

namespace fastsplat::cli {
namespace {

const std::vector<std::string>& order_names() {
  static const std::vector<std::string> names = {"centres", "pixels"};
  return names;
}

template <class Enum>
Enum named(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Enum>(std::ranges::find(names, name) - names.begin());
}

[[noreturn]] void meaningless(const std::string& flag, const std::string& what, const std::string& fix) {
  throw_usage({.where = flag, .what = what, .expected = {}, .got = {}, .fix = fix});
}

void refuse_what_is_of_volumes(const SceneFlags& scene) {
  const auto refuse = [](const char* flag) {
    meaningless(flag, "applies to volumes and cannot be combined with --gaussians", "leave it out");
  };
  if (scene.file) refuse("--scene");
  if (scene.volume) refuse("--volume");
  if (scene.transfer_function) refuse("--tf");
  if (scene.kernel) refuse("--kernel");
  if (scene.nan_as) refuse("--nan-as");
  constexpr std::array kOurs{"--azimuth", "--elevation", "--roll", "--zoom", "--fov", "--background"};
  for (const auto& [flag, text] : scene.settings) {
    if (std::ranges::find(kOurs, flag) == kOurs.end()) refuse(flag.c_str());
  }
}

}  // namespace

void declare(Options& options, GaussianFlags& to) {
  const scene::GaussianDescription usual;
  options.group("3-D Gaussians");
  options.word("--gaussians", to.file, "FILE|NAME",
               "draw a trained scene (a file), or shells:2000 or cloud:500, instead of a volume");
  options.values(scene::synthetic_gaussian_names);
  options.choice("--up", to.up, scene::up_axis_names(), "AXIS",
                 "axis that points up: x, y, z, -x, -y, -z (as declared by the file, else -y; z in built-in scenes)");
  static const std::string low_pass =
      fmt::format("variance added to every footprint, in square pixels, {:g} to {:g} ({:g})", scene::kLowPassLimits.low,
                  scene::kLowPassLimits.high, usual.low_pass);
  static const std::string cutoff = fmt::format("radius of a footprint in standard deviations, {:g} to {:g} ({:g})",
                                                scene::kCutoffLimits.low, scene::kCutoffLimits.high, usual.cutoff);
  declare_strict(options, to.strict);
  options.number("--low-pass", to.low_pass, "NUMBER", low_pass.c_str());
  options.number("--cutoff", to.cutoff, "NUMBER", cutoff.c_str());
  options.choice("--order", to.order, order_names(), "NAME",
                 "golden: sort by depth of centres, or in every pixel: centres, pixels (centres)");
}

GaussianView describe(const GaussianFlags& flags, const SceneFlags& scene) {
  refuse_what_is_of_volumes(scene);
  SceneFlags camera = scene;
  if (!camera.orthographic) camera.perspective = true;
  GaussianView view;
  view.shown = describe(camera);
  view.description.camera = view.shown.camera;
  view.description.width = view.shown.width;
  view.description.height = view.shown.height;
  view.description.up = scene::usual_up(*flags.file);
  if (flags.up) view.description.up = named<scene::UpAxis>(scene::up_axis_names(), *flags.up);
  if (flags.low_pass) view.description.low_pass = *flags.low_pass;
  if (flags.cutoff) view.description.cutoff = *flags.cutoff;
  if (flags.order) view.order = named<golden::GaussianOrder>(order_names(), *flags.order);
  return view;
}

void refuse_without_gaussians(const GaussianFlags& flags) {
  const char* const flag = flags.up         ? "--up"
                           : flags.low_pass ? "--low-pass"
                           : flags.cutoff   ? "--cutoff"
                           : flags.order    ? "--order"
                           : flags.strict   ? "--strict"
                                            : nullptr;
  if (flag != nullptr)
    meaningless(flag, "has no effect without 3-D Gaussians", "add --gaussians FILE, or leave it out");
}

std::vector<std::string> inputs_of(const GaussianFlags& flags) {
  return flags.file ? inputs_of_gaussians(*flags.file) : std::vector<std::string>{};
}

void declare_strict(Options& options, bool& to) {
  options.flag("--strict", to, "refuse a scene with Gaussians that cannot be drawn, instead of dropping them");
}

scene::GaussianCloud read_gaussians(const std::string& name_or_path, bool strict) {
  scene::GaussianCloud cloud;
  as_word(name_or_path, [&] { cloud = scene::load_gaussians(name_or_path); });
  if (strict) scene::refuse_dropped(cloud);
  return cloud;
}

std::vector<std::string> inputs_of_gaussians(const std::string& name_or_path) {
  std::vector<std::string> names;
  for (const auto& path : scene::files_of_gaussians(name_or_path)) names.push_back(path.string());
  return names;
}

scene::GaussianScene build(const GaussianFlags& flags, const GaussianView& view) {
  const auto cloud = std::make_shared<const scene::GaussianCloud>(read_gaussians(*flags.file, flags.strict));
  scene::GaussianDescription description = view.description;
  if (!flags.up && cloud->up) description.up = *cloud->up;
  return scene::build_gaussian_scene(description, cloud);
}

std::vector<Remark> remarks(const scene::GaussianCloud& cloud) {
  std::vector<Remark> remarks;
  for (const auto& text : cloud.remarks) remarks.push_back({Remark::Warning, cloud.name + ": " + text});
  return remarks;
}

ConfigFlags for_gaussians(ConfigFlags flags) {
  if (flags.config) return flags;
  std::vector<std::string> changes;
  for (const std::string change : driver::kGaussianChanges) {
    const std::string key = change.substr(0, change.find('=') + 1);
    if (std::ranges::none_of(flags.changes, [&](const std::string& other) { return other.starts_with(key); }))
      changes.push_back(change);
  }
  flags.config = driver::kGaussianConfig;
  flags.changes.insert(flags.changes.end(), changes.begin(), changes.end());
  return flags;
}

std::vector<Remark> remarks(const scene::ProjectionReport& projection) {
  if (projection.degenerate == 0) return {};
  return {{Remark::Warning,
           fmt::format("{} left out: too long and thin for the precision of doubles; use a smaller --zoom",
                       counted(projection.degenerate, "Gaussian"))}};
}

driver::GaussianFrame compile(const scene::GaussianScene& scene, const cmodel::Config& config, int threads,
                              const Output& output) {
  scene::ProjectionReport projection;
  const auto projected = scene::project_all(scene, &projection, threads);
  output.remark(remarks(projection));
  return {scene, projected, config, threads};
}

std::string summary(const scene::GaussianScene& scene) {
  return fmt::format("{}, {}, degree {}, {}x{} pixels", printable(scene.cloud->name),
                     counted(scene.cloud->gaussians.size(), "Gaussian"), scene.cloud->degree, scene.camera.width(),
                     scene.camera.height());
}

}  // namespace fastsplat::cli
