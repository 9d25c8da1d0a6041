#include "stages/splat_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel/parallel.hpp"
#include "driver/projection.hpp"
#include "driver/tables.hpp"
#include "golden/splat/projection.hpp"
#include "scene/real_splat.hpp"

namespace fastsplat::stages {
namespace {

/// Positions of the whole image: the format has no end.
cmodel::Config without_end(cmodel::Config config) {
  config.position_int_bits = 30 - config.position_frac_bits;
  return config;
}

}  // namespace

SplatList::SplatList(const scene::Scene& scene) {
  const scene::Traversal traversal(scene);
  rows = traversal.rows();
  columns = traversal.columns();
  traversal.visit(traversal.all(), [this](const scene::Splat& splat, std::uint32_t line) {
    splats.push_back(splat);
    lines.push_back(line);
  });
}

SplatSteps::SplatSteps(const scene::Scene& scene, const cmodel::Config& config)
    : scene_(scene),
      config_(config),
      plan_(scene::sheet_plan(scene)),
      slices_(driver::frame_slices(config, scene, plan_)),
      sets_(driver::radius_sets(scene, config)),
      quantiser_(scene, config, sets_, slices_, plan_),
      position_(driver::target(driver::Site::Position, config)),
      depth_(driver::target(driver::Site::Depth, config)),
      whole_(driver::target(driver::Site::Whole, config)),
      phi_word_(driver::target(driver::Site::Phi, config)),
      snap_(without_end(config), cmodel::Site::Snap),
      xray_(scene.description.method == scene::Method::XRay),
      whole_ulp_(1.0 / whole_.scale),
      largest_share_(static_cast<double>(config.colour_format().max) * whole_ulp_),
      depth_ulp_(1.0 / depth_.scale) {
  for (int s = 0; s <= slices_.count(); ++s) boundary_.push_back(slices_.boundary(s) * depth_ulp_);
  const std::vector<std::uint32_t> words = driver::slice_table(config, scene.kernel);
  const auto middle = static_cast<double>(words.size() / 2);
  for (std::size_t i = 0; i < words.size(); ++i) {
    phi_table_.push_back(words[i] / phi_word_.scale);
    phi_real_.push_back(scene.kernel.cumulative((static_cast<double>(i) - middle) * depth_ulp_));
  }
}

int SplatSteps::reach() const {
  if (plan_.use != scene::SheetUse::Sliced) return 1;
  // One more slab than the kernel is long where its ends fall inside slabs, and one at each end for rounded depths.
  return std::min(plan_.slabs.count, static_cast<int>(std::ceil(2.0 * scene_.kernel.radius() / plan_.slabs.width)) + 4);
}

int SplatSteps::first_sheet(const scene::RealSplat& splat, double z, const Mixture& mixture) const {
  if (plan_.use == scene::SheetUse::GridSheet) return splat.sheet;
  if (plan_.use == scene::SheetUse::OneSheet) return 0;
  if (mixture.device(Step::Depth)) return slices_.first(static_cast<std::int32_t>(z * depth_.scale));
  const double slab = std::floor((z - scene_.kernel.radius() - plan_.slabs.first) / plan_.slabs.width);
  return static_cast<int>(std::clamp(slab, 0.0, plan_.slabs.count - 1.0));
}

std::vector<StagedSplat> SplatSteps::staged(const SplatList& list, const Mixture& mixture, bool golden_units,
                                            int threads) const {
  const bool position = mixture.device(Step::Position), snap = mixture.device(Step::Snap),
             radius = mixture.device(Step::Radius), emission = mixture.device(Step::Emission),
             depth = mixture.device(Step::Depth);
  const double unit_value =
      golden_units ? golden::cell_density(scene_) : scene_.amplitude * (xray_ ? scene_.xray_scale : 1.0);
  std::optional<driver::RoundingCarry> carry;
  if (emission && quantiser_.carries()) carry.emplace(quantiser_.carry(0, list.rows, list.columns));

  std::vector<StagedSplat> out(list.splats.size());
  const auto stage = [&](std::size_t i) {
    const scene::RealSplat real = scene::real_splat(scene_, list.splats[i]);
    StagedSplat& splat = out[i];
    const auto centre = [&](double at) {
      if (position) at = static_cast<double>(driver::quantise(at, position_).word) / position_.scale;
      return snap ? snap_(at) : at;
    };
    splat.x = centre(real.at.x);
    splat.y = centre(real.at.y);
    const double own = driver::pixel_radius(scene_, real.at.scale);
    splat.radius = radius ? sets_.radius(sets_.nearest(own)) : own;
    const double ratio = own / splat.radius, amplitude = unit_value * ratio * ratio;
    for (std::size_t c = 0; c < 4; ++c) {
      const double value = real.material[c] * amplitude;
      if (!emission) {
        splat.value[c] = value;
        continue;
      }
      const driver::Quantised word = carry ? (*carry)(value, list.lines[i], c) : driver::quantise(value, whole_);
      splat.value[c] = static_cast<double>(word.word) * whole_ulp_;
    }
    splat.z = !depth ? real.depth
              : plan_.use == scene::SheetUse::Sliced
                  ? slices_.quantise_depth(real.depth - plan_.slabs.first) * depth_ulp_
                  : 0.0;
    splat.first = first_sheet(real, splat.z, mixture);
  };
  if (carry) {  // what rounding left goes from splat to splat
    for (std::size_t i = 0; i < out.size(); ++i) stage(i);
    return out;
  }
  constexpr std::size_t kPiece = 1 << 14;
  parallel_for((out.size() + kPiece - 1) / kPiece, threads, [&](std::size_t piece) {
    for (std::size_t i = piece * kPiece; i < std::min(out.size(), (piece + 1) * kPiece); ++i) stage(i);
  });
  return out;
}

double SplatSteps::behind(const StagedSplat& splat, int boundary, const Mixture& mixture) const {
  return (mixture.device(Step::Depth) ? boundary_[static_cast<std::size_t>(boundary)]
                                      : plan_.slabs.first + boundary * plan_.slabs.width) -
         splat.z;
}

double SplatSteps::phi(const StagedSplat& splat, int boundary, const Mixture& mixture) const {
  if (boundary == 0) return 0.0;
  if (boundary == plan_.slabs.count) return 1.0;
  const bool word = mixture.device(Step::Phi);
  if (mixture.device(Step::Depth)) {
    const auto middle = static_cast<double>(phi_table_.size() / 2);
    const double at = behind(splat, boundary, mixture) * depth_.scale + middle;
    const auto i = static_cast<std::size_t>(std::clamp(at, 0.0, 2.0 * middle));
    return word ? phi_table_[i] : phi_real_[i];
  }
  const double share = scene_.kernel.cumulative(behind(splat, boundary, mixture));
  return word ? static_cast<double>(driver::quantise(share, phi_word_).word) / phi_word_.scale : share;
}

void SplatSteps::shares(const StagedSplat& splat, const Mixture& mixture, std::vector<golden::Sums>& out) const {
  const bool words = mixture.device(Step::Share);
  const auto cut = [&](golden::Sums value) {
    for (double& v : value) v = std::min(v, largest_share_);
    return value;
  };
  out.clear();
  if (plan_.use != scene::SheetUse::Sliced) {
    out.push_back(words ? cut(splat.value) : splat.value);
    return;
  }
  double before = 0.0;      // of the kernel
  golden::Sums in_front{};  // of the words
  for (int slab = splat.first; slab < plan_.slabs.count && before < 1.0; ++slab) {
    const double behind = phi(splat, slab + 1, mixture);
    if (!words) {
      out.push_back(golden::scaled(splat.value, behind - before));
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
