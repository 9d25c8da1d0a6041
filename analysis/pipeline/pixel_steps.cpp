// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/pixel_steps.hpp"

#include <algorithm>
#include <cmath>

#include "driver/tables/density_tables.hpp"
#include "driver/tables/tables.hpp"
#include "driver/tiles/compile.hpp"
#include "golden/splat/composite.hpp"

namespace fastsplat::stages {
namespace {

/// At a transmittance below this, splats behind add less to a pixel than a double can hold.
constexpr double kSpent = 1e-20;

}  // namespace

PixelSteps::PixelSteps(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture,
                       bool golden_units)
    : xray_(scene.description.method == scene::Method::XRay),
      additive_(scene.description.slab_opacity == scene::SlabOpacity::Additive),
      sheet_(mixture.device(Step::Sheet) && !driver::every_sample(scene.description) &&
             !driver::holds_densities(scene.description)),
      factor_(mixture.device(Step::Factor)),
      slab_(mixture.device(Step::Slab)),
      bright_(scene.volume == nullptr),
      composite_(mixture.device(Step::Composite)),
      pixel_(mixture.device(Step::Pixel)),
      sheet_float_(mixture.sum_rounding(Step::Sheet)),
      factor_float_(mixture.rounding(Step::Factor)),
      slab_float_(mixture.rounding(Step::Slab)),
      composite_float_(mixture.rounding(Step::Composite)),
      light_float_(mixture.sum_rounding(Step::Composite)),
      pixel_float_(mixture.rounding(Step::Pixel)),
      exposure_(xray_ && golden_units ? scene.xray_scale : 1.0),
      freeze_below_(mixture.device(Step::Freeze) ? std::ldexp(config.freeze_below, -config.composite_frac_bits)
                                                 : scene.description.culling.freeze),
      sum_(config, cmodel::Site::Sum),
      fall_(config, cmodel::Site::Fall),
      slab_word_(config, cmodel::Site::SlabColour),
      slab_opacity_(config, cmodel::Site::SlabOpacity),
      added_word_(config, cmodel::Site::AddedColour),
      added_opacity_(config, cmodel::Site::AddedOpacity),
      light_(config, cmodel::Site::Light),
      absorbed_(config, cmodel::Site::Absorbed),
      over_(config, cmodel::Site::Over),
      pixel_out_(config, cmodel::Site::PixelOut),
      pixel_sum_(config, cmodel::Site::PixelSum),
      segments_per_tau_(config.opacity_segments / std::ldexp(1.0, config.sheet_int_bits)),
      last_segment_(config.opacity_segments - 1) {
  for (const std::uint32_t word : driver::factor_table(config).words)
    factors_.push_back(std::ldexp(static_cast<double>(word), -config.opacity_frac_bits));
}

golden::Sums PixelSteps::cut(const golden::Sums& sums) const {
  return sheet_ ? golden::Sums{sum_.cut(sums[0]), sum_.cut(sums[1]), sum_.cut(sums[2]), sum_.cut(sums[3])} : sums;
}

double PixelSteps::factor(double tau) const {
  if (!factor_) return factor_float_(tau > 0.0 ? -std::expm1(-tau) / tau : 1.0);
  // Sums that are not saturated can lie beyond the table, where the factor is its last entry.
  const double at = std::min(tau * segments_per_tau_, last_segment_ + 1.0), i = std::min(std::floor(at), last_segment_);
  const auto segment = static_cast<std::size_t>(i);
  return factors_[segment] - fall_((factors_[segment] - factors_[segment + 1]) * (at - i));
}

RealSlab PixelSteps::slab(const golden::Sums& sums) const {
  RealSlab out;
  if (additive_ || (!factor_ && !slab_ && !factor_float_.on() && !slab_float_.on())) {
    const golden::Layer layer =
        golden::make_layer(sums, additive_ ? scene::SlabOpacity::Additive : scene::SlabOpacity::Exponential);
    out = {{layer.red, layer.green, layer.blue}, layer.alpha};
    if (bright_) out = {{sums[0], sums[1], sums[2]}, sums[3]};
    if (!slab_) {
      for (double& value : out.colour) value = slab_float_(value);
      out.opacity = slab_float_(out.opacity);
      return out;
    }
    for (std::size_t c = 0; c < 3; ++c) out.colour[c] = added_word_(sums[c]);
    out.opacity = added_opacity_(sums[3]);
    return out;
  }
  const double f = factor(sums[3]);
  for (std::size_t c = 0; c < 3; ++c) out.colour[c] = slab_ ? slab_word_(sums[c] * f) : slab_float_(sums[c] * f);
  out.opacity = slab_ ? slab_opacity_(sums[3] * f) : slab_float_(sums[3] * f);
  return out;
}

bool PixelSteps::take(const golden::Sums& sheet, golden::Sums& pixel) const {
  if (sheet == golden::Sums{}) return false;
  const golden::Sums sums = cut(sheet);
  if (xray_) {
    for (std::size_t c = 0; c < 4; ++c)
      pixel[c] = sheet_ ? sum_.cut(pixel[c] + sums[c]) : sheet_float_(pixel[c] + sums[c]);
    return false;
  }
  if (frozen(pixel[3])) return true;
  const RealSlab over = slab(sums);
  const double transmittance = pixel[3];
  if (composite_) {
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = over_.cut(pixel[c] + light_(transmittance * over.colour[c]));
    pixel[3] = transmittance - absorbed_(transmittance * over.opacity);
  } else {
    for (std::size_t c = 0; c < 3; ++c)
      pixel[c] = light_float_(pixel[c] + composite_float_(transmittance * over.colour[c]));
    pixel[3] = composite_float_(transmittance * composite_float_(1.0 - over.opacity));
  }
  return frozen(pixel[3]) || pixel[3] < kSpent;
}

golden::Sums PixelSteps::out(const golden::Sums& pixel) const {
  golden::Sums out = pixel;
  if (!xray_) out[3] = 1.0 - pixel[3];
  for (double& value : out) {
    value = pixel_float_(value * exposure_);
    if (pixel_) value = xray_ ? pixel_sum_(value) : pixel_out_(value);
  }
  return out;
}

}  // namespace fastsplat::stages
