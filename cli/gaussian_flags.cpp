// SPDX-License-Identifier: Apache-2.0
#include "cli/gaussian_flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/printable.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "scene/settings.hpp"

namespace fastsplat::cli {
namespace {

const std::vector<std::string>& order_names() {
  static const std::vector<std::string> names = {"centres", "distance", "pixels"};
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
  constexpr std::array kOurs{"--azimuth", "--elevation", "--roll", "--zoom", "--fov", "--crop", "--background"};
  for (const auto& [flag, text] : scene.settings) {
    if (std::ranges::find(kOurs, flag) == kOurs.end()) refuse(flag.c_str());
  }
}

/// Numbers with commas between; empty if one is invalid.
std::vector<double> numbers_from(const std::string& text) {
  std::vector<double> out;
  std::string_view rest = text;
  while (true) {
    const auto comma = rest.find(',');
    const auto number = number_from(rest.substr(0, comma));
    if (!number) return {};
    out.push_back(*number);
    if (comma == std::string_view::npos) return out;
    rest.remove_prefix(comma + 1);
  }
}

std::optional<glm::dvec3> point_from(const std::string& text) {
  const auto numbers = numbers_from(text);
  return numbers.size() == 3 ? std::optional(glm::dvec3(numbers[0], numbers[1], numbers[2])) : std::nullopt;
}

std::string not_a_point(const std::string& text) {
  return point_from(text) ? "" : fmt::format("expected X,Y,Z, three numbers, got '{}'", text);
}

std::string not_a_pose(const std::string& text) {
  const auto numbers = numbers_from(text);
  if (scene::camera_from_matrix(numbers)) return "";
  if (numbers.size() == 12 || numbers.size() == 16)
    return fmt::format("expected a rotation, not mirrored or scaled, and a position, got '{}'", text);
  return fmt::format("expected 12 numbers with commas between, row by row, got '{}'", text);
}

void declare_cameras(Options& options, GaussianFlags& to) {
  options.word(
      "--cameras", to.cameras, "FILE",
      "see the Gaussians from a camera of cameras.json or transforms.json, in its size unless --size is given");
  options.word("--view", to.view, "NAME|N", "the camera's name or number, from 0 (0)");
  options.value(
      "--pose", not_a_pose, [&to](const std::string& text) { to.pose = text; }, "NUMBERS",
      "see the Gaussians from here: matrix from camera (x right, y down, z forward) to scene, 12 numbers row by row");
  options.value(
      "--eye", not_a_point, [&to](const std::string& text) { to.eye = text; }, "X,Y,Z",
      "see the Gaussians from this point of the scene");
  options.value(
      "--look-at", not_a_point, [&to](const std::string& text) { to.look_at = text; }, "X,Y,Z",
      "point in the middle of the picture (the scene's middle)");
  static const std::string near = fmt::format(
      "least depth that is drawn, in the scene's unit ({:g} with --cameras, --pose, --eye; else {:g} of the "
      "eye's distance)",
      scene::kNearPlaced, scene::kNearShare);
  options.number("--near", to.near, "NUMBER", near.c_str());
}

/// Refuses flags that contradict each other or have no effect.
void check_cameras(const GaussianFlags& flags, const SceneFlags& scene) {
  struct Flag {
    const char* name;
    bool given;
  };
  const Flag cameras{"--cameras", flags.cameras.has_value()}, pose{"--pose", flags.pose.has_value()},
      eye{"--eye", flags.eye.has_value()};
  const auto both = [](const Flag& one, const Flag& other) {
    if (one.given && other.given)
      meaningless(one.name, fmt::format("cannot be combined with {}", other.name), "use one of them");
  };
  both(cameras, pose), both(cameras, eye), both(pose, eye);
  const Flag look_at{"--look-at", flags.look_at.has_value()};
  both(cameras, look_at), both(pose, look_at);
  if (flags.view && !cameras.given) meaningless("--view", "requires --cameras", "add --cameras FILE");
  if (flags.look_at && !eye.given) meaningless("--look-at", "requires --eye", "add --eye X,Y,Z");
  const Flag flat{"--orthographic", scene.orthographic}, near{"--near", flags.near.has_value()};
  both(near, flat);
  const auto setting = [&](const char* name) { return Flag{name, scene.settings.contains(name)}; };
  for (const Flag& placed : {cameras, pose, eye})
    for (const Flag& other : {flat, setting("--azimuth"), setting("--elevation"), setting("--zoom")})
      both(placed, other);
  for (const Flag& placed : {cameras, pose})
    for (const Flag& other : {setting("--roll"), Flag{"--up", flags.up.has_value()}}) both(placed, other);
  both(cameras, setting("--fov"));
}

std::optional<scene::PlacedCamera> placed_by(const GaussianFlags& flags) {
  if (flags.pose) return scene::camera_from_matrix(numbers_from(*flags.pose));
  if (!flags.eye) return std::nullopt;
  scene::PlacedCamera camera{.eye = *point_from(*flags.eye)};
  if (flags.look_at) camera.look_at = point_from(*flags.look_at);
  return camera;
}

/// The camera of --cameras.
void use_camera(const scene::CameraFile& file, std::size_t number, const GaussianView& view,
                scene::GaussianDescription& to) {
  const scene::PlacedCamera& camera = file.cameras[number];
  to.placed = camera;
  if (view.size) return;
  to.width = camera.intrinsics->width, to.height = camera.intrinsics->height;
  if (std::max(to.width, to.height) > scene::kMaxImageSide) {
    throw_usage({.where = "--cameras",
                 .what = "the camera's picture is too large",
                 .expected = fmt::format("at most {} pixels a side", scene::kMaxImageSide),
                 .got = fmt::format("{}x{}", to.width, to.height),
                 .fix = "add --size"});
  }
  check_memory(to.width, to.height);
}

}  // namespace

void declare(Options& options, GaussianFlags& to) {
  const scene::GaussianDescription usual;
  options.group("3-D Gaussians");
  options.word("--gaussians", to.file, "FILE|NAME",
               "draw a trained scene (a file), or shells:2000, cloud:500 or outdoor:100000, instead of a volume");
  options.values(scene::synthetic_gaussian_names);
  options.choice("--up", to.up, scene::up_axis_names(), "AXIS",
                 "axis that points up: x, y, z, -x, -y, -z (as declared by the file, else -y; z in built-in scenes)");
  static const std::string low_pass =
      fmt::format("variance added to every footprint, in square pixels, {:g} to {:g} ({:g})", scene::kLowPassLimits.low,
                  scene::kLowPassLimits.high, usual.low_pass);
  static const std::string cutoff = fmt::format("radius of a footprint in standard deviations, {:g} to {:g} ({:g})",
                                                scene::kCutoffLimits.low, scene::kCutoffLimits.high, usual.cutoff);
  declare_strict(options, to.strict);
  declare_cameras(options, to);
  options.number("--low-pass", to.low_pass, "NUMBER", low_pass.c_str());
  options.number("--cutoff", to.cutoff, "NUMBER", cutoff.c_str());
  options.choice("--order", to.order, order_names(), "NAME",
                 "nearest first by depth of centres, by distance from the eye, or (golden) in all pixels: centres, "
                 "distance, pixels (centres)");
}

GaussianView describe(const GaussianFlags& flags, const SceneFlags& scene) {
  refuse_what_is_of_volumes(scene);
  check_cameras(flags, scene);
  SceneFlags camera = scene;
  if (!camera.orthographic) camera.perspective = true;
  GaussianView view;
  if (const auto crop = camera.settings.find("--crop"); crop != camera.settings.end()) {
    view.crop = scene::real_box_from(crop->second);
    camera.settings.erase(crop);
  }
  view.shown = describe(camera);
  view.description.camera = view.shown.camera;
  view.description.width = view.shown.width;
  view.description.height = view.shown.height;
  if (scene.size) view.size = {view.shown.width, view.shown.height};
  view.description.placed = placed_by(flags);
  view.description.near = flags.near;
  view.description.up = scene::usual_up(*flags.file);
  if (flags.up) view.description.up = named<scene::UpAxis>(scene::up_axis_names(), *flags.up);
  if (flags.low_pass) view.description.low_pass = *flags.low_pass;
  if (flags.cutoff) view.description.cutoff = *flags.cutoff;
  if (flags.order == "pixels") {
    view.order = golden::GaussianOrder::Pixels;
  } else if (flags.order) {
    view.description.order = named<scene::GaussianSort>(order_names(), *flags.order);
  }
  return view;
}

GaussianView describe_for_device(const GaussianFlags& flags, const SceneFlags& scene) {
  const GaussianView view = describe(flags, scene);
  if (view.order == golden::GaussianOrder::Centres) return view;
  throw_usage({.where = "--order",
               .what = "a device draws Gaussians in one order for all pixels",
               .expected = "centres or distance",
               .got = "pixels",
               .fix = "leave it out; `fastsplat compare` measures what the order costs"});
}

void refuse_without_gaussians(const GaussianFlags& flags) {
  const char* const flag = flags.up         ? "--up"
                           : flags.low_pass ? "--low-pass"
                           : flags.cutoff   ? "--cutoff"
                           : flags.order    ? "--order"
                           : flags.cameras  ? "--cameras"
                           : flags.view     ? "--view"
                           : flags.pose     ? "--pose"
                           : flags.eye      ? "--eye"
                           : flags.look_at  ? "--look-at"
                           : flags.near     ? "--near"
                           : flags.strict   ? "--strict"
                                            : nullptr;
  if (flag != nullptr)
    meaningless(flag, "has no effect without 3-D Gaussians", "add --gaussians FILE, or leave it out");
}

std::vector<std::string> inputs_of(const GaussianFlags& flags) {
  std::vector<std::string> files = flags.file ? inputs_of_gaussians(*flags.file) : std::vector<std::string>{};
  if (flags.cameras) files.push_back(*flags.cameras);
  return files;
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
  scene::GaussianDescription description = view.description;
  std::optional<scene::CameraFile> cameras;
  if (flags.cameras) {
    cameras = scene::load_cameras(*flags.cameras, view.size);
    use_camera(*cameras, flags.view ? scene::find_camera(*cameras, *flags.view) : 0, view, description);
  }
  auto cloud = read_gaussians(*flags.file, flags.strict);
  if (view.crop) scene::crop(cloud, *view.crop);
  if (!flags.up && cloud.up) description.up = *cloud.up;
  if (cameras) cloud.remarks.insert(cloud.remarks.end(), cameras->remarks.begin(), cameras->remarks.end());
  return scene::build_gaussian_scene(description, std::make_shared<const scene::GaussianCloud>(std::move(cloud)));
}

std::vector<scene::GaussianDescription> frames_of(const scene::Sequence& sequence, const GaussianView& view) {
  std::vector<scene::GaussianDescription> frames(static_cast<std::size_t>(sequence.frames), view.description);
  for (int frame = 0; frame < sequence.frames; ++frame)
    frames[static_cast<std::size_t>(frame)].camera = scene::at_frame(sequence, view.shown, frame).camera;
  return frames;
}

std::vector<scene::GaussianDescription> frames_of_cameras(const GaussianFlags& flags, const GaussianView& view) {
  const scene::CameraFile file = scene::load_cameras(*flags.cameras, view.size);
  std::vector<scene::GaussianDescription> frames(file.cameras.size(), view.description);
  for (std::size_t number = 0; number < frames.size(); ++number) use_camera(file, number, view, frames[number]);
  return frames;
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
  return {
      {Remark::Warning, fmt::format("{} left out: too long and thin for the precision of doubles; move the camera away",
                                    counted(projection.degenerate, "Gaussian"))}};
}

namespace {

/// "use --set ...": a configuration whose words hold such a colour.
std::string brighter(const cmodel::Config& config, double brightest) {
  const int bits = static_cast<int>(std::floor(std::log2(brightest))) + 1;
  if (bits > cmodel::find_key("colour.int_bits")->max)
    return fmt::format("no configuration holds a colour of {:.3g}", brightest);
  std::string flags = "use";
  const auto set = [&](const char* key, int from, int to) {
    if (to != from) flags += fmt::format(" --set {}={}", key, to);
  };
  set("colour.int_bits", config.colour_int_bits, bits);
  set("colour.frac_bits", config.colour_frac_bits, std::min(config.colour_frac_bits, 16 - bits));
  set("sheet.int_bits", config.sheet_int_bits, std::max(config.sheet_int_bits, bits + config.radial_int_bits));
  set("pixel.int_bits", config.pixel_int_bits, std::max(config.pixel_int_bits, bits));
  return flags;
}

}  // namespace

std::vector<Remark> remarks(const driver::GaussianReport& report, const cmodel::Config& config) {
  std::vector<Remark> said;
  const auto warn = [&](std::uint64_t count, const std::string& what) {
    if (count > 0) said.push_back({Remark::Warning, counted(count, "Gaussian") + what});
  };
  warn(report.cut, " clipped at the reach of an ellipse record; use a smaller --size, or move the camera away");
  warn(report.thin,
       " too long and thin for an ellipse's words to hold the shape; `fastsplat errors` says what that costs, under "
       "step "
       "radius");
  if (report.saturated > 0)
    warn(report.saturated,
         " brighter than the device's input allows and clamped; " + brighter(config, report.brightest));
  if (report.vanished > 0)
    said.push_back(
        {Remark::Note, counted(report.vanished, "Gaussian") + " vanished: too transparent for the device's input"});
  return said;
}

driver::GaussianFrame compile(const scene::GaussianScene& scene, const cmodel::Config& config, const Common& common,
                              const Output& output) {
  scene::ProjectionReport projection;
  std::vector<scene::ProjectedGaussian> projected;
  {
    ProgressBar bar("projecting", watching(common));
    projected = scene::project_all(scene, &projection, common.threads, bar.callback());
  }
  output.remark(remarks(projection));
  driver::GaussianFrame frame(scene, projected, config, common.threads);
  output.remark(remarks(frame.report(), config));
  return frame;
}

std::string summary(const scene::GaussianScene& scene) {
  const std::string name = scene.description.placed ? scene.description.placed->name : "";
  return fmt::format("{}, {}, degree {}, {}x{} pixels{}", printable(scene.cloud->name),
                     counted(scene.cloud->gaussians.size(), "Gaussian"), scene.cloud->degree, scene.camera.width(),
                     scene.camera.height(), name.empty() ? "" : ", camera " + printable(name));
}

}  // namespace fastsplat::cli
