// SPDX-License-Identifier: Apache-2.0
#include "cmodel/numbers/sites.hpp"

#include <utility>

namespace fastsplat::cmodel {
namespace {

template <std::size_t... I>
std::array<Narrowing, kSiteCount> all(const Config& config, std::index_sequence<I...> /*sites*/) {
  return {narrowing(config, static_cast<Site>(I))...};
}

}  // namespace

Narrowing narrowing(const Config& c, Site site) {
  const auto saturating = [](int rounding, int from_frac, const Format& to) {
    return Narrowing(static_cast<Rounding>(rounding), Overflow::SAT, from_frac, to);
  };
  constexpr int kExact = static_cast<int>(Rounding::TRN);  // sums of words of one format drop nothing
  const int of = c.opacity_frac_bits, sf = c.sheet_frac_bits, tf = c.composite_frac_bits;
  switch (site) {
    case Site::Snap:
      return saturating(c.rounding_snap, c.position_frac_bits, c.snapped_format());
    case Site::AxisProduct:
      return saturating(static_cast<int>(Rounding::RND), 2 * c.axis_weight_format().frac_bits, c.weight_format());
    case Site::RadialFall:
      return saturating(static_cast<int>(Rounding::RND), c.radial_frac_bits + c.rlut_guard_bits,
                        signed_format(c.radial_int_bits + 1, c.radial_frac_bits));
    case Site::Product:
      return saturating(c.rounding_product, c.colour_frac_bits + c.radial_frac_bits, c.sheet_format());
    case Site::Sum:
    case Site::SumOver:
      return saturating(kExact, sf, c.sheet_format());
    case Site::Fall:
      return saturating(c.rounding_fall, of + c.opacity_remainder_bits(), c.factor_format());
    case Site::SlabColour:
      return saturating(c.rounding_slab, sf + of, c.slab_format());
    case Site::SlabOpacity:
      return saturating(c.rounding_slab, sf + of, c.transmittance_format());
    case Site::AddedColour:
      return saturating(c.rounding_slab, sf, c.slab_format());
    case Site::AddedOpacity:
      return saturating(c.rounding_slab, sf, c.transmittance_format());
    case Site::Light:
      return saturating(c.rounding_light, 2 * tf, c.slab_format());
    case Site::Absorbed:
      return saturating(c.rounding_light, 2 * tf, c.transmittance_format());
    case Site::Over:
      return saturating(kExact, tf, c.composited_format());
    case Site::PixelOut:
      return saturating(c.rounding_pixel, tf, c.pixel_format());
    case Site::PixelSum:
      break;
  }
  return saturating(c.rounding_pixel, sf, c.pixel_format());
}

Sites::Sites(const Config& config) : table_(all(config, std::make_index_sequence<kSiteCount>())) {}

}  // namespace fastsplat::cmodel
