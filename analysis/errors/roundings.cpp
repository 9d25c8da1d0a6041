// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/roundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "driver/splats/rounding_carry.hpp"
#include "driver/tables/tables.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Step;

/// The most that a site moves a number: half an ulp, one ulp if it truncates, 0 if no bit is dropped.
double step_of(const cmodel::Config& config, cmodel::Site site) {
  const cmodel::Narrowing narrowing = cmodel::narrowing(config, site);
  if (narrowing.dropped_bits() == 0) return 0.0;
  return std::ldexp(narrowing.rounding() == cmodel::Rounding::TRN ? 1.0 : 0.5, -narrowing.to().frac_bits);
}

/// Position and snap together: half a step of the 1/K grid if they round once.
double place_of(const cmodel::Config& c) {
  const bool once = driver::target(driver::Site::Position, c).rounding == driver::Target::Rounding::Down;
  if (once) return std::ldexp(0.5, -c.grid_bits());
  const double position = std::ldexp(0.5, -c.position_frac_bits);
  return c.grid_bits() == c.position_frac_bits ? position : position + step_of(c, cmodel::Site::Snap);
}

double weight_of(const cmodel::Config& config, const scene::Kernel& kernel) {
  const std::vector<double> real = driver::radial_samples(config, kernel);
  const std::vector<std::uint32_t> words = driver::radial_table(config, kernel).words;
  double most = 0.0;
  for (std::size_t t = 0; t < real.size(); ++t)
    most = std::max(most, std::abs(std::ldexp(static_cast<double>(words[t]), -config.radial_frac_bits) - real[t]));
  return config.interpolates() ? most + step_of(config, cmodel::Site::RadialFall) : most;
}

/// Largest height of an interpolated table's line above F, or depth below it where its ends were scaled down. In the
/// middle of a step h a chord of exp(-u) is h^2/8 of it too high, and scale = tanh(h/2)/(h/2) > 1 - h^2/12.
double chord_of(const cmodel::Config& config, const scene::Kernel& kernel) {
  const double step = kernel.a() * kernel.radius() * kernel.radius() / config.radial_entries;
  return step * step / 8.0;
}

/// With error diffusion a word differs from its own value by the error of the splat before. rest = t - shown(floor(t))
/// lies between the least and the largest of V - shown(V), and up to 1 above; the word between rest - 1 and rest more.
double emission_of(const cmodel::Config& config, const scene::Kernel& kernel, bool carries) {
  const double ulp = std::ldexp(1.0, -config.colour_frac_bits);
  if (!carries) return 0.5 * ulp;
  const driver::ShownWords shown(config, kernel);
  double least = 0.0, most = 0.0;
  for (std::int64_t word = 0; word < 256; ++word) {
    const double hidden = static_cast<double>(word) - shown(word);
    least = std::min(least, hidden);
    most = std::max(most, hidden);
  }
  return std::max(1.0 - least, 1.0 + most) * ulp;
}

/// A chord of a convex function lies above it by at most h^2/8 of its second derivative, for (1-exp(-t))/t at most 1/3;
/// both ends and the fall are rounded.
double factor_of(const cmodel::Config& c) {
  const double segment = std::ldexp(1.0, c.sheet_int_bits) / c.opacity_segments;
  return segment * segment / 24.0 + std::ldexp(0.5, -c.opacity_frac_bits) + step_of(c, cmodel::Site::Fall);
}

}  // namespace

Roundings::Roundings(const stages::Chain& chain, const stages::Mixture& known, const stages::Mixture& device) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const scene::Scene& scene = chain.scene();
  const cmodel::Config& c = chain.config();
  const bool gaussians = chain.gaussians() != nullptr, samples = driver::every_sample(scene.description);
  const auto open = [&](Step step) { return device.device(step) && !known.device(step); };
  const auto greatest = [](const cmodel::Format& format) {
    return std::ldexp(static_cast<double>(format.max), -format.frac_bits);
  };
  if (open(Step::Snap)) place = place_of(c);
  if (open(Step::Position)) ellipse_place = std::ldexp(0.5, -c.position_frac_bits);
  radius = open(Step::Radius);
  // Two words, each half a guard step off; an entry stands for the middle of its step.
  if (open(Step::Distance)) {
    distance = std::ldexp(1.0, -c.rlut_guard_bits);
    if (chain.shaped()) coefficient = std::ldexp(0.5, -c.rlut_guard_bits - c.ellipse_format().frac_bits);
  }
  if (open(Step::Index)) index = c.interpolates() ? std::ldexp(1.0, -c.rlut_guard_bits) : 0.5;
  if (open(Step::Index) && c.interpolates()) weight += chord_of(c, scene.kernel);
  if (open(Step::Weight)) weight += weight_of(c, scene.kernel);
  largest_whole = largest_share = largest_sum = largest_slab = largest_light = largest_pixel = kEndless;
  if (open(Step::Emission)) {
    carries = chain.carries();
    emission = emission_of(c, scene.kernel, carries);
    // Words of Gaussians are those of records; of a volume's splats U 4.cf.
    largest_whole = gaussians ? greatest(c.colour_format()) : 16.0 - std::ldexp(1.0, -c.colour_frac_bits);
  }
  if (open(Step::Depth)) depth = std::ldexp(1.0, -c.slice_phase_bits);
  if (open(Step::Phi)) phi = std::ldexp(0.5, -c.slice_frac_bits);
  shares_known = known.device(Step::Share);
  if (open(Step::Share) && !gaussians) {
    share = std::ldexp(0.5, -c.colour_frac_bits);
    last_share = device.device(Step::Emission) ? 0.0 : share;
    largest_share = greatest(c.colour_format());
  }
  if (open(Step::Product)) product = step_of(c, cmodel::Site::Product);
  if (open(samples ? Step::Product : Step::Sheet)) largest_sum = greatest(c.sheet_format());
  const bool additive = scene.description.slab_opacity == scene::SlabOpacity::Additive;
  if (open(Step::Factor) && !additive) factor = factor_of(c);
  if (open(Step::Slab)) {
    slab = step_of(c, additive ? cmodel::Site::AddedColour : cmodel::Site::SlabColour);
    largest_slab = greatest(c.slab_format());
  }
  if (open(Step::Composite)) {
    composite = step_of(c, cmodel::Site::Light);
    largest_light = greatest(c.composited_format());
  }
  freeze = device.device(Step::Freeze) ? std::ldexp(c.freeze_below, -c.composite_frac_bits)
                                       : scene.description.culling.freeze;
  if (open(Step::Pixel)) {
    const bool xray = scene.description.method == scene::Method::XRay;
    pixel = step_of(c, xray ? cmodel::Site::PixelSum : cmodel::Site::PixelOut);
    largest_pixel = greatest(c.pixel_format());
  }
}

}  // namespace fastsplat::analysis
