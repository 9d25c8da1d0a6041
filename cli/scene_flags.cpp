// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_flags.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/number_text.hpp"
#include "base/printable.hpp"
#include "cli/names.hpp"
#include "scene/scene_file.hpp"
#include "scene/settings.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

struct Size {
  int width, height;
};

Size size_from(const std::string& text) {
  const auto cross = text.find('x');
  const auto width = integer_from<int>(std::string_view(text).substr(0, cross));
  const auto height = cross == std::string::npos ? width : integer_from<int>(std::string_view(text).substr(cross + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > scene::kMaxImageSide ||
      *height > scene::kMaxImageSide) {
    throw_usage({.where = "--size",
                 .what = "not an image size",
                 .expected = fmt::format("N or WxH, each from 1 to {}", scene::kMaxImageSide),
                 .got = "'" + text + "'",
                 .fix = "for example --size 512 or --size 640x480"});
  }
  return {*width, *height};
}

[[noreturn]] void contradiction(const std::string& what, const std::string& fix) {
  throw_usage({.where = {}, .what = what, .expected = {}, .got = {}, .fix = fix});
}

template <class T, class U>
void set(T& to, const std::optional<U>& from) {
  if (from) to = *from;
}

// --kernel-a alone keeps the radius of the kernel named before; likewise --kernel-radius.
void apply_kernel(const SceneFlags& flags, scene::SceneDescription& to) {
  const bool shaped = flags.settings.contains("--kernel-a") || flags.settings.contains("--kernel-radius");
  if (flags.kernel && shaped) {
    contradiction("--kernel cannot be combined with --kernel-a or --kernel-radius",
                  "use either --kernel, or --kernel-a and --kernel-radius");
  }
  set(to.kernel, flags.kernel);
  if (!shaped || to.kernel.empty()) return;
  const auto named = scene::kernel_by_name(to.kernel);
  to.kernel_a = named.a();
  to.kernel_radius = named.radius();
  to.kernel.clear();
}

void apply_camera(const SceneFlags& flags, scene::SceneDescription& to) {
  if (flags.perspective && flags.orthographic)
    contradiction("--perspective cannot be combined with --orthographic", "use one of them");
  if (flags.perspective) to.camera.projection = scene::Projection::Perspective;
  if (flags.orthographic) to.camera.projection = scene::Projection::Orthographic;
}

std::vector<std::string> demo_words() {
  std::vector<std::string> words;
  for (const auto& name : scene::demo_names()) words.push_back("demo:" + name);
  return words;
}

/// The given flags that belong to settings.
std::vector<scene::Given> given_by(const SceneFlags& flags) {
  std::vector<scene::Given> given;
  for (const scene::Setting& setting : scene::settings()) {
    if (flags.settings.contains(setting.flag)) given.push_back({&setting});
  }
  return given;
}

void set_checked(const scene::Setting& setting, const std::string& text, scene::SceneDescription& to) {
  if (const std::string problem = scene::problem_with(setting, text); !problem.empty())
    throw_usage({.where = setting.flag,
                 .what = problem,
                 .expected = {},
                 .got = {},
                 .fix = "`fastsplat volume info` prints the number of voxels"});
  scene::set_from_text(setting, text, to);
}

}  // namespace

void check_memory(int width, int height) {
  constexpr double kBytesPerPixel = 96.0;
  const double need = kBytesPerPixel * width * height;
  const auto have = static_cast<double>(machine_memory());
  if (have > 0 && need > have) {
    throw_usage({.where = "--size",
                 .what = fmt::format("an image of {}x{} needs about {:.1f} GB", width, height, need / 1e9),
                 .expected = fmt::format("at most {:.1f} GB, this machine's memory", have / 1e9),
                 .got = {},
                 .fix = "use a smaller --size"});
  }
}

void declare_nan_as(Options& options, std::optional<double>& to) {
  options.number("--nan-as", to, "VALUE", "value that replaces NaN and infinite voxels, which are refused otherwise");
}

volume::ReadOptions reading(const std::optional<double>& nan_as) {
  if (!nan_as) return {};
  if (!(std::abs(*nan_as) <= scene::kLargestVoxel)) {
    throw_usage({.where = "--nan-as",
                 .what = "not a valid voxel value",
                 .expected = "a finite number in the range of a float",
                 .got = fmt::format("{}", *nan_as),
                 .fix = "for example --nan-as 0"});
  }
  return {.nan_as = static_cast<float>(*nan_as)};
}

void declare(Options& options, SceneFlags& to) {
  options.group("Scene");
  options.word("--scene", to.file, "FILE|demo:NAME",
               "scene.toml or demo:NAME (listed by `doctor`); flags below override it");
  options.values(demo_words);
  options.word("--volume", to.volume, "NAME|PATH", "NRRD/NIfTI/MetaImage file or built-in like shells:128");
  options.values(volume::known_volume_names);
  declare_nan_as(options, to.nan_as);
  options.word("--tf", to.transfer_function, "NAME|FILE", "transfer function: a preset or a TOML file");
  options.values(scene::transfer_function_presets);
  options.word("--kernel", to.kernel, "NAME", "kernel by name: gauss2 (a=2,R=2), smooth (a=1.35,R=2)");
  options.values(scene::kernel_names);
  options.group("Camera");
  options.word("--size", to.size, "N|WxH", "image size: N (square) or WxH");
  options.flag("--perspective", to.perspective, "perspective projection");
  options.flag("--orthographic", to.orthographic, "orthographic projection (default)");
  for (const scene::Setting& setting : scene::settings()) {
    if (*setting.flag == '\0') continue;
    options.group(setting.group);
    // A box of Gaussians is one of any numbers; describe() checks one of voxels.
    const bool box = std::holds_alternative<scene::Box>(setting.value);
    options.value(
        setting.flag,
        [&setting, box](const std::string& text) {
          return box && scene::real_box_from(text) ? std::string{} : scene::problem_with(setting, text);
        },
        [&to, &setting](const std::string& text) { to.settings[setting.flag] = text; }, setting.unit, setting.help);
    if (const auto* choice = std::get_if<scene::Choice>(&setting.value)) options.values(choice->names);
    if (std::holds_alternative<scene::Switch>(setting.value))
      options.values([] { return std::vector<std::string>{"on", "off"}; });
  }
}

scene::SceneDescription describe(const SceneFlags& flags, const scene::Sequence* sequence) {
  const scene::SceneFile file = flags.file ? scene::read_scene_file(*flags.file) : scene::SceneFile{};
  scene::SceneDescription to = file.description;
  if (flags.volume) check_volume_name(*flags.volume);
  set(to.volume, flags.volume);
  if (flags.volume) to.volume_place.clear();
  if (const auto& tf = flags.transfer_function; tf && !tf->empty())
    as_word(*tf, [&] { scene::load_transfer_function(*tf); });
  set(to.transfer_function, flags.transfer_function);
  if (flags.transfer_function) to.transfer_function_place.clear();
  if (flags.nan_as) to.nan_as = reading(flags.nan_as).nan_as;
  apply_kernel(flags, to);
  apply_camera(flags, to);
  if (flags.size) {
    const auto [width, height] = size_from(*flags.size);
    to.width = width;
    to.height = height;
  }
  check_memory(to.width, to.height);
  for (const scene::Setting& setting : scene::settings()) {
    const auto flag = flags.settings.find(setting.flag);
    if (flag != flags.settings.end()) set_checked(setting, flag->second, to);
    if (flag != flags.settings.end() && std::holds_alternative<scene::Box>(setting.value)) to.crop_place.clear();
  }
  for (const auto& given : {given_by(flags), file.idle}) {
    auto idle = scene::idle_of(given, to);
    if (sequence) idle = scene::idle_of(std::move(idle), *sequence, to);
    scene::refuse_idle(idle, to);
  }
  return to;
}

void refuse_display(const SceneFlags& flags) {
  for (const char* flag : {"--background", "--xray-invert"}) {
    if (!flags.settings.contains(flag)) continue;
    throw_usage({.where = flag,
                 .what = "has no effect: this subcommand writes no picture",
                 .expected = {},
                 .got = {},
                 .fix = "leave it out, or use `fastsplat render`"});
  }
}

scene::Scene build(const SceneFlags& flags) { return scene::build_scene(describe(flags)); }

std::string summary(const scene::Scene& scene) {
  const auto& dims = scene.volume->dims;
  const bool xray = scene.description.method == scene::Method::XRay;
  const std::string exposure =
      !xray
          ? ""
          : fmt::format(", exposure {:.6g}{}", scene.xray_scale,
                        scene.description.xray_exposure > 0.0 ? "" : " (automatic; --xray-exposure sets a fixed one)");
  return fmt::format("{} {}x{}x{}, {}, {}, {}x{} pixels{}", printable(scene.volume->name), dims.x, dims.y, dims.z,
                     scene.transfer_function.name, scene::to_string(scene.description.method), scene.camera.width(),
                     scene.camera.height(), exposure);
}

}  // namespace fastsplat::cli
