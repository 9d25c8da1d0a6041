// SPDX-License-Identifier: Apache-2.0
#include "driver/tables/density_tables.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "cmodel/classify/classify_tables.hpp"
#include "scene/shading.hpp"
#include "scene/transfer_function.hpp"
#include "scene/value_range.hpp"

namespace fastsplat::driver {
namespace {

using cmodel::Table;
namespace classify = cmodel::classify;

/// floor(value 2^f + 1/2), clamped to low..high.
std::int64_t nearest(double value, int frac_bits, std::int64_t low, std::int64_t high) {
  const double scaled = std::floor(std::ldexp(value, frac_bits) + 0.5);
  return static_cast<std::int64_t>(std::clamp(scaled, static_cast<double>(low), static_cast<double>(high)));
}
std::uint32_t word(double value, const cmodel::Format& format) {
  return static_cast<std::uint32_t>(nearest(value, format.frac_bits, format.min, format.max));
}

/// Materials at i/Q of the volume's range. A clear entry has the colour of the nearest visible one: a line from a clear
/// entry to a visible one must not begin in black (N-8-69).
cmodel::LoadTable classify_table(const cmodel::Config& config, const scene::Scene& scene) {
  const scene::Classifier classify(scene.transfer_function, *scene.volume);
  const double base = scene.volume->min, range = static_cast<double>(scene.volume->max) - base;
  const int segments = 1 << config.classify_segment_bits;
  std::vector<scene::Material> at;
  for (int i = 0; i <= segments; ++i) at.push_back(classify.evaluate(base + range * i / segments));
  std::vector<int> nearest_seen(at.size(), -1);
  for (int i = 0, seen = -1; i <= segments; ++i) {
    if (at[static_cast<std::size_t>(i)].extinction > 0.0F) seen = i;
    nearest_seen[static_cast<std::size_t>(i)] = seen;
  }
  for (int i = segments, seen = -1; i >= 0; --i) {
    if (at[static_cast<std::size_t>(i)].extinction > 0.0F) seen = i;
    int& nearest = nearest_seen[static_cast<std::size_t>(i)];
    if (seen >= 0 && (nearest < 0 || seen - i < i - nearest)) nearest = seen;
  }
  const double depth = scene.description.opacity_scale * scene.description.slab_width;
  cmodel::LoadTable table{.table = Table::Classify, .radius = {}, .words = {}};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const glm::vec3 colour =
        nearest_seen[i] < 0 ? glm::vec3(0.0F) : at[static_cast<std::size_t>(nearest_seen[i])].colour;
    for (int c = 0; c < 3; ++c) table.words.push_back(word(colour[c], cmodel::unit_format(classify::kColour)));
    table.words.push_back(word(static_cast<double>(at[i].extinction) * depth, config.sheet_format()));
  }
  return table;
}

cmodel::LoadTable root_table(const cmodel::Config& config) {
  cmodel::LoadTable table{.table = Table::Root, .radius = {}, .words = {}};
  for (std::int64_t i = 0; i < cmodel::classify_words(config, Table::Root); ++i) {
    const double m = 1.0 + std::ldexp(static_cast<double>(i), -classify::kRootBits);
    table.words.push_back(word(1.0 / std::sqrt(m), cmodel::unit_format(classify::kRoot)));
  }
  return table;
}

cmodel::LoadTable glint_table(const cmodel::Config& config, const scene::Scene& scene) {
  cmodel::LoadTable table{.table = Table::Glint, .radius = {}, .words = {}};
  for (std::int64_t i = 0; i < cmodel::classify_words(config, Table::Glint); ++i) {
    const double facing = std::ldexp(static_cast<double>(i), -classify::kGlintBits);
    table.words.push_back(word(std::pow(facing, scene.shading.shininess), cmodel::unit_format(classify::kPhong)));
  }
  return table;
}

cmodel::LoadTable lighting_table(const scene::Scene& scene) {
  cmodel::LoadTable table{.table = Table::Lighting, .radius = {}, .words = {}};
  const scene::Camera& camera = scene.camera;
  const scene::Shader shade(scene.shading, camera, *scene.volume);
  const auto add = [&](double value, int frac_bits, std::int64_t low, std::int64_t high) {
    table.words.push_back(static_cast<std::uint32_t>(nearest(value, frac_bits, low, high)));
  };
  const std::int64_t one = std::int64_t{1} << classify::kLight;
  for (const glm::dvec3 vector : {glm::dvec3(shade.light()), glm::dvec3(shade.half())}) {
    for (const glm::dvec3& axis : {camera.right(), camera.down(), camera.direction()})
      add(glm::dot(vector, axis), classify::kLight, -one, one);
  }
  for (const double factor : {scene.shading.ambient, scene.shading.diffuse, scene.shading.specular})
    table.words.push_back(word(factor, cmodel::unsigned_format(4, classify::kPhong)));
  const auto tilt = [&](double x, double y, const glm::dvec3& axis) {
    const scene::Ray ray = camera.ray(x, y);
    return glm::dot(ray.direction, axis) / ray.depth_per_mm;
  };
  const cmodel::Format steps = cmodel::signed_format(4, classify::kTilt);
  const double x0 = tilt(0.0, 0.0, camera.right()), y0 = tilt(0.0, 0.0, camera.down());
  for (const double value : {x0, tilt(1.0, 0.0, camera.right()) - x0, y0, tilt(0.0, 1.0, camera.down()) - y0})
    add(value, classify::kTilt, steps.min, steps.max);
  return table;
}

cmodel::LoadTable sheets_table(const scene::Scene& scene, const scene::SlabGrid& slabs) {
  cmodel::LoadTable table{.table = Table::Sheets, .radius = {}, .words = {}};
  const double unit = scene.volume->kernel_unit();
  const cmodel::Format scale = cmodel::unit_format(classify::kScale);
  constexpr std::int64_t kMost = 0xFFFFFFFF;
  const double floor = gradient_floor(scene);
  for (int s = 0; s < slabs.count; ++s) {
    const double depth = (slabs.first + (s + 0.5) * slabs.width) * unit;
    const double pixels = scene.camera.project(scene.camera.direction() * depth).scale * unit;
    const double across = pixels / 2.0, along = 1.0 / (2.0 * slabs.width), most = std::max(across, along);
    table.words.push_back(word(across / most, scale) | word(along / most, scale) << 16);
    const std::int64_t per_floor = floor > 0.0 ? nearest(most / floor, classify::kFloor, 0, kMost) : kMost;
    table.words.push_back(static_cast<std::uint32_t>(scene.shading.on ? per_floor : 0));
  }
  return table;
}

}  // namespace

bool holds_densities(const scene::SceneDescription& description) {
  return description.classify == scene::ClassifyOrder::Post;
}

void check_densities(const scene::Scene& scene) {
  if (!holds_densities(scene.description)) return;
  const double base = scene.volume->min;
  if (scene::Classifier(scene.transfer_function, *scene.volume).transparent(base, base)) return;
  throw_usage(
      {.where = "classify.order",
       .what =
           "the transfer function shows the volume's smallest value, and a device cannot tell where the volume ends",
       .expected = "opacity 0 at the smallest value",
       .got = {},
       .fix = "use --engine golden, or a transfer function that starts with opacity 0"});
}

double gradient_floor(const scene::Scene& scene) {
  const double range = static_cast<double>(scene.volume->max) - scene.volume->min;
  return scene.shading.gradient_floor * (range > 0.0 ? scene::spread(*scene.volume) / range : 1.0);
}

std::vector<cmodel::LoadTable> density_tables(const cmodel::Config& config, const scene::Scene& scene,
                                              const scene::SlabGrid& slabs) {
  return {classify_table(config, scene), root_table(config), glint_table(config, scene), lighting_table(scene),
          sheets_table(scene, slabs)};
}

}  // namespace fastsplat::driver
