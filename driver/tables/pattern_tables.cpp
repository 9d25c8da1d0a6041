// SPDX-License-Identifier: Apache-2.0
#include "driver/tables/pattern_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel/parallel.hpp"
#include "cmodel/classify/pattern_tables.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tables/quantise.hpp"
#include "scene/solid_texture.hpp"
#include "scene/transfer_function.hpp"

namespace fastsplat::driver {
namespace {

using cmodel::Table;
namespace pattern = cmodel::pattern;

std::uint32_t near_word(double value, const cmodel::Format& format) {
  return quantise_to<std::uint32_t>(value, {Target::Rounding::Nearest, Target::Overflow::Saturates, format});
}

/// The least voxel value near which something may be visible (N-8-75).
float least_seen(const cmodel::Config& config, const scene::Scene& scene) {
  const scene::Classifier classify(scene.transfer_function, *scene.volume);
  const double base = scene.volume->min, range = static_cast<double>(scene.volume->max) - base;
  const int segments = 1 << config.classify_segment_bits;
  int first = 1;
  while (first <= segments && !(classify.evaluate(base + range * first / segments).extinction > 0.0F)) ++first;
  if (first > segments) return std::numeric_limits<float>::infinity();
  // A kernel's sum over the voxels ripples by less than a tenth of a value.
  return static_cast<float>(base + 0.9 * range * (first - 1) / segments);
}

/// The visible range of columns, rows or sheets, rounded outwards.
struct Range {
  std::int64_t first = 0, last = 0;
};

/// The visible ranges in this order: columns, rows, sheets.
std::array<Range, 3> seen(const cmodel::Config& config, const scene::Scene& scene, const scene::SlabGrid& slabs) {
  const volume::Volume& volume = *scene.volume;
  const scene::Classifier classify(scene.transfer_function, volume);
  const bool densities = holds_densities(scene.description);
  const float least = densities ? least_seen(config, scene) : 0.0F;
  const double unit = volume.kernel_unit(), radius = scene.kernel.radius() * unit;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  glm::dvec3 low(kNone), high(-kNone);
  for (int k = 0; k < volume.dims.z; ++k) {
    for (int j = 0; j < volume.dims.y; ++j) {
      for (int i = 0; i < volume.dims.x; ++i) {
        const float value = volume.at(i, j, k);
        if (!(densities ? value > volume.min && value >= least : classify(value).extinction > 0.0F)) continue;
        const scene::ScreenPoint at = scene.camera.project(volume.position(i, j, k));
        const glm::dvec3 place(at.x, at.y, (at.depth / unit - slabs.first) / slabs.width - 0.5);
        const glm::dvec3 reach(radius * at.scale, radius * at.scale, radius / unit / slabs.width);
        low = glm::min(low, place - reach);
        high = glm::max(high, place + reach);
      }
    }
  }
  const std::array<int, 3> counts{scene.camera.width(), scene.camera.height(), slabs.count};
  std::array<Range, 3> out;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(high[axis] >= low[axis])) continue;
    const double most = counts[static_cast<std::size_t>(axis)] - 1;
    out[static_cast<std::size_t>(axis)] = {static_cast<std::int64_t>(std::clamp(std::floor(low[axis]), 0.0, most)),
                                           static_cast<std::int64_t>(std::clamp(std::ceil(high[axis]), 0.0, most))};
  }
  return out;
}

/// Node positions along one axis.
struct Axis {
  std::uint32_t first = 0, step = 0;                                           ///< words
  bool between() const { return step != std::uint32_t{1} << pattern::kStep; }  ///< pixels lie between nodes
  double at(int node) const { return first + node / std::ldexp(static_cast<double>(step), -pattern::kStep); }
};

Axis axis_of(const Range& range, int nodes) {
  const auto length = static_cast<double>(range.last - range.first);
  const double step = length > 0.0 ? std::min(1.0, (nodes - 1) / length) : 1.0;
  return {.first = static_cast<std::uint32_t>(range.first),
          .step = near_word(step, cmodel::unsigned_format(8, pattern::kStep))};
}

/// A pattern's value and its lean at a node.
struct Node {
  double value = 0.0;
  glm::dvec3 lean{0.0};  ///< right, down, ahead
};

Node node_at(const scene::Scene& scene, const glm::dvec3& position) {
  const scene::Texture& texture = scene.description.texture;
  const scene::Bump& bump = scene.description.bump;
  Node out;
  if (texture.kind != scene::SolidKind::None) out.value = scene::solid_field(texture.kind, position / texture.scale);
  if (bump.kind == scene::SolidKind::None) return out;
  const glm::dvec3 slope = bump.amplitude * scene::solid_gradient(bump.kind, position / bump.scale);
  const scene::Camera& camera = scene.camera;
  out.lean = {glm::dot(slope, camera.right()), glm::dot(slope, camera.down()), glm::dot(slope, camera.direction())};
  return out;
}

std::vector<Node> nodes_of(const scene::Scene& scene, const scene::SlabGrid& slabs, const std::array<Axis, 3>& axes,
                           int side, int threads) {
  const double unit = scene.volume->kernel_unit();
  const auto n = static_cast<std::size_t>(side);
  std::vector<Node> out(n * n * n);
  parallel_for(n, threads, [&](std::size_t k) {
    const double depth = (slabs.first + (axes[2].at(static_cast<int>(k)) + 0.5) * slabs.width) * unit;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        const scene::Ray ray = scene.camera.ray(axes[0].at(static_cast<int>(i)), axes[1].at(static_cast<int>(j)));
        out[(k * n + j) * n + i] = node_at(scene, ray.origin + ray.direction * (depth / ray.depth_per_mm));
      }
    }
  });
  return out;
}

/// A line between two points of a curve is off by 1/12 of the second difference on average: nodes are moved by as much
/// the other way (N-8-78).
std::vector<Node> levelled(const std::vector<Node>& nodes, const std::array<Axis, 3>& axes, int side, int threads) {
  const auto n = static_cast<std::size_t>(side);
  std::vector<Node> out = nodes;
  parallel_for(n, threads, [&](std::size_t k) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::array<std::size_t, 3> at{i, j, k};
        std::size_t step = 1;
        const std::size_t here = (k * n + j) * n + i;
        for (std::size_t axis = 0; axis < 3; ++axis, step *= n) {
          if (!axes[axis].between() || at[axis] == 0 || at[axis] == n - 1) continue;
          const Node &left = nodes[here - step], &right = nodes[here + step], &middle = nodes[here];
          out[here].value -= (left.value + right.value - 2.0 * middle.value) / 12.0;
          out[here].lean -= (left.lean + right.lean - 2.0 * middle.lean) / 12.0;
        }
      }
    }
  });
  return out;
}

/// The tints lo and hi of pattern values 0 and 1; between them the tint is linear.
std::array<glm::dvec3, 2> tints_of(const scene::Texture& texture) {
  if (texture.kind == scene::SolidKind::None) return {glm::dvec3(1.0), glm::dvec3(1.0)};
  return {scene::tint_of_value(texture, 0.0), scene::tint_of_value(texture, 1.0)};
}

}  // namespace

bool has_pattern(const scene::SceneDescription& description) {
  return description.bump.kind != scene::SolidKind::None || (description.texture.kind != scene::SolidKind::None &&
                                                             description.texture.where == scene::TextureWhere::Pixel);
}

std::vector<cmodel::LoadTable> pattern_tables(const cmodel::Config& config, const scene::Scene& scene,
                                              const scene::SlabGrid& slabs, int threads) {
  const int side = 1 << config.pattern_node_bits;
  std::array<Axis, 3> axes;
  const std::array<Range, 3> ranges = seen(config, scene, slabs);
  for (std::size_t axis = 0; axis < 3; ++axis) axes[axis] = axis_of(ranges[axis], side);
  const std::vector<Node> nodes = levelled(nodes_of(scene, slabs, axes, side, threads), axes, side, threads);

  double steepest = 0.0;
  for (const Node& node : nodes)
    for (int axis = 0; axis < 3; ++axis) steepest = std::max(steepest, std::abs(node.lean[axis]));
  const auto amount =
      quantise_to<std::uint32_t>(steepest, {Target::Rounding::Up, Target::Overflow::Saturates,
                                            cmodel::unsigned_format(pattern::kAmountInt, pattern::kAmount)});
  const double unit_lean = amount == 0 ? 0.0 : std::ldexp(1.0 / amount, pattern::kAmount);

  cmodel::LoadTable table{.table = Table::Nodes, .radius = {}, .words = {}};
  table.words.reserve(pattern::kNodeWords * nodes.size());
  const cmodel::Format value = cmodel::unsigned_format(0, pattern::kValue),
                       lean = cmodel::signed_format(1, pattern::kLean);
  for (const Node& node : nodes) {
    const auto half = [&](int axis) { return near_word(node.lean[axis] * unit_lean, lean) & 0xFFFFU; };
    table.words.push_back(near_word(node.value, value) | half(0) << 16);
    table.words.push_back(half(1) | half(2) << 16);
  }
  cmodel::LoadTable pattern{.table = Table::Pattern, .radius = {}, .words = {}};
  for (const Axis& axis : axes) pattern.words.push_back(axis.first);
  for (const Axis& axis : axes) pattern.words.push_back(axis.step);
  for (const glm::dvec3& tint : tints_of(scene.description.texture))
    for (int c = 0; c < 3; ++c) pattern.words.push_back(near_word(tint[c], cmodel::unit_format(pattern::kTint)));
  pattern.words.push_back(amount);
  return {std::move(table), std::move(pattern)};
}

}  // namespace fastsplat::driver
