#include "cli/scene_flags.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>

#include "base/error.hpp"

namespace fastsplat::cli {
namespace {

constexpr int kMaxSide = 16384;

struct Size {
  int width, height;
};

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

Size size_from(const std::string& text) {
  const auto cross = text.find('x');
  const auto width = whole_number(std::string_view(text).substr(0, cross));
  const auto height = cross == std::string::npos ? width : whole_number(std::string_view(text).substr(cross + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > kMaxSide || *height > kMaxSide) {
    throw_usage({.where = "--size",
                 .what = "not an image size",
                 .expected = fmt::format("N or WxH, each from 1 to {}", kMaxSide),
                 .got = "'" + text + "'",
                 .fix = "for example --size 512 or --size 640x480"});
  }
  return {*width, *height};
}

// Both engines keep some frames of doubles or words; a picture that cannot fit in memory is refused before it is begun.
void check_memory(int width, int height) {
  constexpr double kBytesPerPixel = 96.0;
  const double need = kBytesPerPixel * width * height;
  const double have = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  if (have > 0 && need > have) {
    throw_usage({.where = "--size",
                 .what = fmt::format("an image of {}x{} needs about {:.1f} GB", width, height, need / 1e9),
                 .expected = fmt::format("at most {:.1f} GB, this machine's memory", have / 1e9),
                 .got = {},
                 .fix = "use a smaller --size"});
  }
}

[[noreturn]] void contradiction(const std::string& what, const std::string& fix) {
  throw_usage({.where = {}, .what = what, .expected = {}, .got = {}, .fix = fix});
}

template <class T, class U>
void set(T& to, const std::optional<U>& from) {
  if (from) to = *from;
}

void apply_kernel(const SceneFlags& flags, scene::SceneDescription& to) {
  if (flags.kernel && (flags.kernel_a || flags.kernel_radius)) {
    contradiction("--kernel names a and R already", "give either --kernel or --kernel-a and --kernel-radius");
  }
  set(to.kernel, flags.kernel);
  if (!flags.kernel_a && !flags.kernel_radius) return;
  if (!to.kernel.empty()) {
    const auto named = scene::kernel_by_name(to.kernel);
    to.kernel_a = named.a();
    to.kernel_radius = named.radius();
    to.kernel.clear();
  }
  set(to.kernel_a, flags.kernel_a);
  set(to.kernel_radius, flags.kernel_radius);
}

void apply_camera(const SceneFlags& flags, scene::SceneDescription& to) {
  if (flags.perspective && flags.orthographic)
    contradiction("--perspective and --orthographic exclude each other", "give one");
  auto& camera = to.camera;
  if (flags.perspective) camera.projection = scene::Projection::Perspective;
  if (flags.orthographic) camera.projection = scene::Projection::Orthographic;
  if (flags.fov && camera.projection == scene::Projection::Orthographic) {
    contradiction("--fov means nothing to an orthographic camera", "add --perspective, or use --zoom");
  }
  set(camera.azimuth, flags.azimuth);
  set(camera.elevation, flags.elevation);
  set(camera.roll, flags.roll);
  set(camera.zoom, flags.zoom);
  set(camera.fov, flags.fov);
}

}  // namespace

scene::SceneDescription describe(const SceneFlags& flags) {
  scene::SceneDescription to = flags.file ? scene::load_scene_file(*flags.file) : scene::SceneDescription{};
  set(to.volume, flags.volume);
  set(to.transfer_function, flags.transfer_function);
  apply_kernel(flags, to);
  apply_camera(flags, to);
  if (flags.size) {
    const auto [width, height] = size_from(*flags.size);
    to.width = width;
    to.height = height;
  }
  check_memory(to.width, to.height);
  if (flags.method) to.method = scene::method_from(*flags.method);
  set(to.slab_width, flags.slab_width);
  if (flags.slab_opacity) to.slab_opacity = scene::slab_opacity_from(*flags.slab_opacity);
  set(to.xray_sheets, flags.xray_sheets);
  set(to.xray_exposure, flags.xray_exposure);
  if (flags.shading) to.shading = *flags.shading == "on" ? 1 : 0;
  set(to.opacity_scale, flags.opacity_scale);
  return to;
}

scene::Scene build(const SceneFlags& flags) { return scene::build_scene(describe(flags)); }

std::string summary(const scene::Scene& scene) {
  const auto& dims = scene.volume->dims;
  return fmt::format("{} {}x{}x{}, {}, {}, {}x{} pixels", scene.volume->name, dims.x, dims.y, dims.z,
                     scene.transfer_function.name, scene::to_string(scene.description.method), scene.camera.width(),
                     scene.camera.height());
}

}  // namespace fastsplat::cli
