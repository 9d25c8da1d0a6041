#include "scene/scene_limits.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

using D = SceneDescription;

constexpr double kDegrees = 3600.0;

constexpr std::array<RealSetting, 10> kReals{{
    {"", "opacity_scale", 1e-6, 1e6, [](D& d) -> double& { return d.opacity_scale; }},
    {"camera", "azimuth", -kDegrees, kDegrees, [](D& d) -> double& { return d.camera.azimuth; }},
    {"camera", "elevation", -kDegrees, kDegrees, [](D& d) -> double& { return d.camera.elevation; }},
    {"camera", "roll", -kDegrees, kDegrees, [](D& d) -> double& { return d.camera.roll; }},
    {"camera", "zoom", 1e-6, 1e6, [](D& d) -> double& { return d.camera.zoom; }},
    {"camera", "fov", 1.0, 150.0, [](D& d) -> double& { return d.camera.fov; }},
    {"kernel", "a", 0.1, 20.0, [](D& d) -> double& { return d.kernel_a; }},
    {"kernel", "radius", 0.5, 8.0, [](D& d) -> double& { return d.kernel_radius; }},
    {"slabs", "width", 0.01, 64.0, [](D& d) -> double& { return d.slab_width; }},
    {"xray", "exposure", 0.0, 1e9, [](D& d) -> double& { return d.xray_exposure; }},
}};

constexpr std::array<IntegerSetting, 3> kIntegers{{
    {"image", "width", 1, kMaxImageSide, [](D& d) -> int& { return d.width; }},
    {"image", "height", 1, kMaxImageSide, [](D& d) -> int& { return d.height; }},
    {"xray", "sheets", 1, 65535, [](D& d) -> int& { return d.xray_sheets; }},
}};

template <typename Setting>
void check(const Setting& setting, D description) {
  const auto value = setting.field(description);
  if (value >= setting.low && value <= setting.high) return;
  throw_usage({.where = {},
               .what = fmt::format("{}{}{} is out of range", setting.table, *setting.table ? " " : "", setting.key),
               .expected = fmt::format("{}..{}", setting.low, setting.high),
               .got = fmt::format("{}", value),
               .fix = "choose a value inside"});
}

}  // namespace

std::span<const RealSetting> real_settings() { return kReals; }
std::span<const IntegerSetting> integer_settings() { return kIntegers; }

void check_limits(const SceneDescription& description) {
  assert(description.shading >= -1 && description.shading <= 1);
  for (const auto& setting : kReals) check(setting, description);
  for (const auto& setting : kIntegers) check(setting, description);
}

}  // namespace fastsplat::scene
