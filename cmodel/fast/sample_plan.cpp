// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/sample_plan.hpp"

#include "cmodel/numbers/sites.hpp"

namespace fastsplat::cmodel::fast {
namespace {

bool to_even(const Narrowing& site) { return site.rounding() == Rounding::RND_CONV && site.dropped_bits() > 0; }

Rounded rounded(const Narrowing& site) {
  const int dropped = site.dropped_bits();
  const bool nearest = site.rounding() == Rounding::RND && dropped > 0;
  return {.bias = nearest ? std::uint32_t{1} << (dropped - 1) : 0, .dropped = dropped};
}

}  // namespace

std::optional<SamplePlan> sample_plan(const Config& config, const FastPlan& plan, const char** why_not) {
  const auto none = [why_not](const char* reason) {
    if (why_not != nullptr) *why_not = reason;
    return std::optional<SamplePlan>{};
  };
  const Narrowing fall = narrowing(config, Site::Fall), slab = narrowing(config, Site::SlabColour),
                  added = narrowing(config, Site::AddedColour), light = narrowing(config, Site::Light);
  if (to_even(fall) || to_even(slab) || to_even(added) || to_even(light)) return none("samples are rounded to even");
  const int grown = added.dropped_bits() > 0 ? 0 : config.composite_frac_bits - config.sheet_frac_bits;
  if (config.composite_frac_bits > 16 || config.opacity_frac_bits > 16 ||
      config.opacity_frac_bits + config.opacity_remainder_bits() > 31 ||
      config.sheet_int_bits + config.sheet_frac_bits + grown > 31 || slab.dropped_bits() > 31 ||
      slab.from_frac() < slab.to().frac_bits)
    return none("words of transmittance, slab factor or sheet are too wide for the sample lanes");
  SamplePlan out;
  out.product = plan.narrow ? Rounded{.bias = 1U << 14, .dropped = 15} : Rounded{plan.bias, plan.dropped_bits};
  out.added = rounded(added);
  out.grown = grown;
  out.fall = rounded(fall);
  out.segment_bits = config.opacity_remainder_bits();
  out.slab = rounded(slab);
  out.light = rounded(light);
  out.one = std::uint32_t{1} << config.composite_frac_bits;
  out.most = static_cast<std::uint32_t>(config.composited_format().max);
  out.wide = config.colour_int_bits > 0;
  out.most_slab = static_cast<std::uint32_t>(config.slab_format().max);
  out.freeze_below = static_cast<std::uint32_t>(config.freeze_below);
  return out;
}

}  // namespace fastsplat::cmodel::fast
