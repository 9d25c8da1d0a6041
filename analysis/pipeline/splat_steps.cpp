// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/splat_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/parallel/parallel.hpp"
#include "driver/splats/projection.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tables/tables.hpp"
#include "driver/tiles/compile.hpp"
#include "golden/splat/projection.hpp"
#include "scene/kernel_growth.hpp"
#include "scene/real_splat.hpp"

namespace fastsplat::stages {
namespace {

/// The position format widened to the whole image.
cmodel::Config without_end(cmodel::Config config) {
  config.position_int_bits = 30 - config.position_frac_bits;
  return config;
}

/// A pixel for the centre's word, and as far as q is off at the record's far corner (docs/numerics.md, N-4.6-7), but no
/// farther than its windows.
double beyond_edge(const cmodel::Config& config, double reach_x, double reach_y) {
  const double longest = static_cast<double>(cmodel::kEllipseWindows) * config.lanes;
  const auto pixels = [&](double reach) { return std::min(2.0 * reach + config.lanes, longest); };
  const double i = pixels(reach_x), j = pixels(reach_y);
  const double off =
      std::ldexp(1.0 + i + i * i + j + j * j + i * j, -config.rlut_guard_bits - config.ellipse_format().frac_bits - 1);
  return 1.0 + std::min(std::max(reach_x, reach_y) * (std::sqrt(1.0 + off / config.radial_entries) - 1.0),
                        static_cast<double>(config.lanes));
}

}  // namespace

void set_ellipse(const cmodel::Config& config, const scene::ScreenShape& footprint, const cmodel::EllipseShape& words,
                 const Mixture& mixture, StagedShape& shape) {
  shape.words = words;
  const driver::EllipseReach drawn = driver::reach(config, words);
  shape.beyond = beyond_edge(config, drawn.x, drawn.y);
  if (!mixture.device(Step::Radius)) {
    const double entries = config.radial_entries, determinant = footprint.determinant();
    const RoundToFloat& narrow = mixture.rounding(Step::Radius);
    shape.unit = {narrow(footprint.yy / determinant), narrow(-2.0 * footprint.xy / determinant),
                  narrow(footprint.xx / determinant)};
    shape.a = entries * shape.unit[0];
    shape.b = entries * shape.unit[1];
    shape.c = entries * shape.unit[2];
    shape.reach_x = std::sqrt(footprint.xx);
    shape.reach_y = std::sqrt(footprint.yy);
    return;
  }
  const int steps = 2 * config.position_frac_bits - config.rlut_guard_bits - static_cast<int>(words.shift);
  shape.a = std::ldexp(words.a, steps);
  shape.b = std::ldexp(words.b, steps);
  shape.c = std::ldexp(words.c, steps);
  shape.unit = {shape.a / config.radial_entries, shape.b / config.radial_entries, shape.c / config.radial_entries};
  shape.reach_x = drawn.x;
  shape.reach_y = drawn.y;
}

glm::ivec3 voxel_of(const volume::Volume& volume, const scene::Splat& splat) {
  // Positions are floats, far nearer to their voxel than to any other.
  return {glm::round(volume.to_grid(glm::dvec3(splat.position)) / volume.spacing + 0.5 * glm::dvec3(volume.dims - 1))};
}

SplatList::SplatList(const scene::Scene& scene) {
  const bool densities = driver::holds_densities(scene.description);
  const scene::Traversal traversal(scene, densities ? scene::SplatKind::Densities : scene::SplatKind::Colours);
  rows = traversal.rows();
  columns = traversal.columns();
  traversal.visit(traversal.all(),
                  [this](std::span<const scene::Splat> of_row, std::span<const std::uint32_t> their_lines) {
                    splats.insert(splats.end(), of_row.begin(), of_row.end());
                    lines.insert(lines.end(), their_lines.begin(), their_lines.end());
                  });
  if (densities) order_densities(*scene.volume);
}

SplatList SplatList::part(std::span<const std::uint32_t> which) const {
  SplatList out;
  out.rows = rows;
  out.columns = columns;
  for (const std::uint32_t i : which) {
    out.splats.push_back(splats[i]);
    out.lines.push_back(lines[i]);
  }
  return out;
}

void SplatList::order_densities(const volume::Volume& volume) {
  const auto voxel_of = [&](const scene::Splat& splat) {
    const glm::ivec3 at = stages::voxel_of(volume, splat);
    return volume.index(at.x, at.y, at.z);
  };
  std::vector<std::pair<std::size_t, std::uint32_t>> order;  // voxel, number in the traversal
  order.reserve(splats.size());
  for (const scene::Splat& splat : splats)
    order.emplace_back(voxel_of(splat), static_cast<std::uint32_t>(order.size()));
  std::ranges::sort(order);
  std::vector<scene::Splat> sorted;
  std::vector<std::uint32_t> sorted_lines;
  traversed.resize(order.size());
  for (const auto& [voxel, number] : order) {
    traversed[number] = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(splats[number]);
    sorted_lines.push_back(lines[number]);
    above.push_back(volume.voxels[voxel] - volume.min);
  }
  splats = std::move(sorted);
  lines = std::move(sorted_lines);
}

SplatSteps::SplatSteps(const scene::Scene& scene, const cmodel::Config& config)
    : scene_(scene),
      config_(config),
      plan_(driver::plan_for_device(scene)),
      slices_(driver::frame_slices(config, scene, plan_)),
      sets_(driver::radius_sets(scene, config)),
      quantiser_(scene, config, sets_, slices_, plan_),
      position_(driver::target(driver::Site::Position, config)),
      centre_(driver::target(driver::Site::EllipseCentre, config)),
      shrink_(driver::target(driver::Site::Shrink, config)),
      depth_(driver::target(driver::Site::Depth, config)),
      whole_(driver::target(driver::Site::Whole, config)),
      phi_word_(driver::target(driver::Site::Phi, config)),
      snap_(without_end(config), cmodel::Site::Snap),
      xray_(scene.description.method == scene::Method::XRay),
      density_(1.0 / ((static_cast<double>(scene.volume->max) - scene.volume->min) * scene.description.slab_width)),
      whole_ulp_(1.0 / whole_.scale),
      largest_share_(static_cast<double>(config.colour_format().max) * whole_ulp_),
      depth_ulp_(1.0 / depth_.scale) {
  if (driver::draws_ellipses(scene, config)) shaper_.emplace(scene);
  for (int s = 0; s <= slices_.count(); ++s) boundary_.push_back(slices_.boundary(s) * depth_ulp_);
  const std::vector<std::uint32_t> words = driver::slice_table(config, scene.kernel);
  const auto middle = static_cast<double>(words.size() / 2);
  for (std::size_t i = 0; i < words.size(); ++i) {
    phi_table_.push_back(words[i] / phi_word_.scale);
    phi_real_.push_back(scene.kernel.cumulative((static_cast<double>(i) - middle) * depth_ulp_));
  }
}

int SplatSteps::reach(const Mixture& mixture) const {
  if (plan_.use != scene::SheetUse::Sliced) return 1;
  if (mixture.floats(Step::Depth)) return plan_.slabs.count;  // coarse floats bring many boundaries together
  // One slab more than the kernel's length if its ends fall inside slabs, and one at each end for rounded depths; a
  // shrink is off by half a word at most.
  const double growth = shaped() ? scene::largest_growth(scene_) : 1.0, ulp = 0.5 / shrink_.scale;
  const double deepest = growth > 1.0 ? 1.0 / std::max(1.0 / growth - ulp, ulp) : 1.0;
  return std::min(plan_.slabs.count,
                  static_cast<int>(std::ceil(2.0 * scene_.kernel.radius() * deepest / plan_.slabs.width)) + 4);
}

int SplatSteps::first_sheet(const scene::RealSplat& splat, double z, const Mixture& mixture,
                            const Growth& growth) const {
  if (plan_.use == scene::SheetUse::GridSheet) return splat.sheet;
  if (plan_.use == scene::SheetUse::OneSheet) return 0;
  if (mixture.device(Step::Depth))
    return slices_.first(static_cast<std::int32_t>(z * depth_.scale), slices_.growth(growth.shrink));
  const double slab = std::floor((z - scene_.kernel.radius() * growth.real - plan_.slabs.first) / plan_.slabs.width);
  return static_cast<int>(std::clamp(slab, 0.0, plan_.slabs.count - 1.0));
}

void SplatSteps::circle(const scene::RealSplat& real, const Mixture& mixture, double unit_value,
                        StagedSplat& splat) const {
  const bool position = mixture.device(Step::Position), snap = mixture.device(Step::Snap);
  const RoundToFloat& narrow = centre_rounding(mixture);
  const auto centre = [&](double at) {
    at = narrow(at);
    if (position) at = static_cast<double>(driver::quantise(at, position_).word) / position_.scale;
    return snap ? snap_(at) : at;
  };
  splat.x = centre(real.at.x);
  splat.y = centre(real.at.y);
  const double own = driver::pixel_radius(scene_, real.at.scale);
  splat.radius = mixture.device(Step::Radius) ? sets_.radius(sets_.nearest(own)) : own;
  const double ratio = own / splat.radius;
  splat.value = golden::scaled(real.material, unit_value * ratio * ratio);
}

StagedShape SplatSteps::shape(const scene::Splat& voxel, const scene::RealSplat& real, const Mixture& mixture,
                              double unit_value, StagedSplat& splat) const {
  const double kernel_radius = scene_.kernel.radius();
  const scene::ShapedSplat shaped = (*shaper_)(voxel, real, golden::scaled(real.material, unit_value));
  const scene::ScreenShape& s = shaped.shape;
  StagedShape out;
  out.screen = s;
  out.growth = {shaped.depth_growth, driver::quantise_to<std::uint32_t>(1.0 / shaped.depth_growth, shrink_)};
  const bool device = mixture.device(Step::Radius);
  const double radius = kernel_radius * std::sqrt(s.xx);
  const bool circle = s.xy == 0.0 && s.xx == s.yy && std::abs(radius - sets_.radius(0)) <= driver::kSameRadius * radius;
  if (circle && device) return out;
  splat.radius = radius;
  splat.value = shaped.value;
  if (circle) return out;
  out.own = true;
  const auto word = [this](double at) { return driver::quantise_to<std::int32_t>(at, centre_); };
  out.word_x = word(real.at.x);
  out.word_y = word(real.at.y);
  const bool position = mixture.device(Step::Position);
  const RoundToFloat& narrow = centre_rounding(mixture);
  splat.x = position ? out.word_x / centre_.scale : narrow(real.at.x);
  splat.y = position ? out.word_y / centre_.scale : narrow(real.at.y);

  const double square = kernel_radius * kernel_radius;
  const scene::ScreenShape footprint{square * s.xx, square * s.xy, square * s.yy},
      drawn = driver::drawn_footprint(s, kernel_radius);
  set_ellipse(config_, footprint, driver::ellipse_words(config_, drawn), mixture, out);
  if (device && drawn.xx != footprint.xx)  // too thin: fainter by the same factor
    splat.value = golden::scaled(splat.value, std::sqrt(square * square * s.determinant() / drawn.determinant()));
  return out;
}

Staged SplatSteps::staged(const SplatList& list, const Mixture& mixture, bool golden_units, int threads,
                          Staged memory) const {
  const bool emission = mixture.device(Step::Emission), depth = mixture.device(Step::Depth);
  const double unit_value =
      golden_units ? golden::cell_density(scene_) : scene_.amplitude * (xray_ ? scene_.xray_scale : 1.0);
  std::optional<driver::RoundingCarry> carry;
  if (emission && quantiser_.carries()) carry.emplace(quantiser_.carry(0, list.rows, list.columns));

  Staged out = std::move(memory);
  out.splats.resize(list.splats.size());
  if (shaped()) out.shapes.resize(list.splats.size());
  const auto stage = [&](std::size_t i) {
    scene::RealSplat real = scene::real_splat(scene_, list.splats[i]);
    // The device's step emission uses the driver's densities, which are floats.
    if (!list.above.empty() && !emission)
      real.material[3] = golden_units ? static_cast<double>(list.above[i]) : list.above[i] * density_;
    StagedSplat& splat = out.splats[i];
    circle(real, mixture, unit_value, splat);
    if (shaped()) out.shapes[i] = shape(list.splats[i], real, mixture, unit_value, splat);
    const Growth growth = shaped() ? out.shapes[i].growth : Growth{};
    driver::RoundingCarry::Line* const line = carry ? &carry->next(list.lines[i], list.splats[i].sheet) : nullptr;
    for (double& value : splat.value) value = mixture.rounding(Step::Emission)(value);
    for (std::size_t c = 0; emission && c < 4; ++c) {
      const double value = splat.value[c];
      const driver::Quantised word = carry ? (*carry)(value, *line, c) : driver::quantise(value, whole_);
      splat.value[c] = static_cast<double>(word.word) * whole_ulp_;
    }
    splat.z = !depth ? mixture.rounding(Step::Depth)(real.depth)
              : plan_.use == scene::SheetUse::Sliced
                  ? slices_.quantise_depth(real.depth - plan_.slabs.first) * depth_ulp_
                  : 0.0;
    splat.first = first_sheet(real, splat.z, mixture, growth);
    // As floats, a boundary may come to lie behind the kernel's beginning.
    while (mixture.floats(Step::Depth) && plan_.use == scene::SheetUse::Sliced && splat.first > 0 &&
           phi(splat, splat.first, mixture, growth) > 0.0)
      --splat.first;
  };
  if (carry) {  // rounding errors go from splat to splat
    for (std::size_t i = 0; i < out.splats.size(); ++i) stage(list.traversed.empty() ? i : list.traversed[i]);
  } else {
    constexpr std::size_t kPiece = 1 << 14;
    parallel_for((out.splats.size() + kPiece - 1) / kPiece, threads, [&](std::size_t piece) {
      for (std::size_t i = piece * kPiece; i < std::min(out.splats.size(), (piece + 1) * kPiece); ++i) stage(i);
    });
  }
  double reach = 0.0;
  for (const StagedShape& shape : out.shapes) reach = std::max({reach, shape.reach_x, shape.reach_y});
  driver::check_reach(reach, config_);
  return out;
}

double SplatSteps::behind(const StagedSplat& splat, int boundary, const Mixture& mixture) const {
  const RoundToFloat& narrow = mixture.rounding(Step::Depth);
  return narrow((mixture.device(Step::Depth) ? boundary_[static_cast<std::size_t>(boundary)]
                                             : narrow(plan_.slabs.first + boundary * plan_.slabs.width)) -
                splat.z);
}

double SplatSteps::phi(const StagedSplat& splat, int boundary, const Mixture& mixture, const Growth& growth) const {
  if (boundary == 0) return 0.0;
  if (boundary == plan_.slabs.count) return 1.0;
  const bool word = mixture.device(Step::Phi);
  if (mixture.device(Step::Depth)) {
    const auto middle = static_cast<double>(phi_table_.size() / 2);
    const double steps = behind(splat, boundary, mixture) * depth_.scale;
    const double at = std::floor(steps * growth.shrink / shrink_.scale) + middle;
    const auto i = static_cast<std::size_t>(std::clamp(at, 0.0, 2.0 * middle));
    return word ? phi_table_[i] : mixture.rounding(Step::Phi)(phi_real_[i]);
  }
  const double share =
      mixture.rounding(Step::Phi)(scene_.kernel.cumulative(behind(splat, boundary, mixture) / growth.real));
  return word ? static_cast<double>(driver::quantise(share, phi_word_).word) / phi_word_.scale : share;
}

void SplatSteps::shares(const StagedSplat& splat, const Mixture& mixture, std::vector<golden::Sums>& out,
                        const Growth& growth) const {
  const bool words = mixture.device(Step::Share);
  const RoundToFloat& narrow = mixture.rounding(Step::Share);
  const auto cut = [&](golden::Sums value) {
    for (double& v : value) v = std::min(v, largest_share_);
    return value;
  };
  out.clear();
  if (plan_.use != scene::SheetUse::Sliced) {
    out.push_back(words ? cut(splat.value) : splat.value);
    return;
  }
  double before = 0.0;      // of the kernel in front of the slab
  golden::Sums in_front{};  // words in front of the slab
  for (int slab = splat.first; slab < plan_.slabs.count && before < 1.0; ++slab) {
    const double behind = phi(splat, slab + 1, mixture, growth);
    if (!words) {
      golden::Sums share = golden::scaled(splat.value, narrow(behind - before));
      for (double& value : share) value = narrow(value);
      out.push_back(share);
    } else {
      golden::Sums share;
      for (std::size_t c = 0; c < 4; ++c) {
        const double end = std::floor(splat.value[c] * behind * whole_.scale + 0.5) * whole_ulp_;
        share[c] = end - in_front[c];
        in_front[c] = end;
      }
      out.push_back(cut(share));
    }
    before = behind;
  }
}

}  // namespace fastsplat::stages
