// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/fast_plan.hpp"

#include <algorithm>

#include "cmodel/numbers/sites.hpp"

namespace fastsplat::cmodel::fast {

std::optional<FastPlan> fast_plan(const Config& config, const char** why_not) {
  const auto none = [why_not](const char* reason) {
    if (why_not != nullptr) *why_not = reason;
    return std::optional<FastPlan>{};
  };
  const Narrowing product = narrowing(config, Site::Product);
  const int colour_bits = config.colour_bits(), weight_bits = config.radial_int_bits + config.radial_frac_bits;
  const int sheet_bits = config.sheet_int_bits + config.sheet_frac_bits;
  const int dropped = product.dropped_bits();
  const std::int64_t largest_product = ((std::int64_t{1} << colour_bits) - 1) * ((std::int64_t{1} << weight_bits) - 1);
  const bool nearest = product.rounding() == Rounding::RND;
  if (!nearest && product.rounding() != Rounding::TRN && dropped > 0) return none("products are rounded to even");
  if (colour_bits > 16 || weight_bits > 16 || sheet_bits > 32)
    return none("words of colour, weight or sheet are too wide for the vector lanes");
  if (product.from_frac() < product.to().frac_bits) return none("sheets have more fraction bits than products");
  if (product(largest_product).overflow) return none("a product may exceed a sheet's word");
  if ((config.tile_width + config.lanes - 1) / config.lanes > 64) return none("a tile's row has more than 64 blocks");

  if (config.cull_map == static_cast<int>(CullMap::Pixel))
    return none("cull.map = pixel finds hidden splats by single pixels");

  FastPlan plan{.largest_sum = static_cast<std::uint32_t>(config.sheet_format().max)};
  // Shift both factors left until 15 bits of the product are dropped. Each must remain a positive word of 16 bits.
  const int grow = 15 - dropped, colour_room = 15 - colour_bits, weight_room = 15 - weight_bits;
  if (nearest && dropped > 0 && grow >= 0 && colour_room >= 0 && weight_room >= 0 &&
      grow <= colour_room + weight_room && sheet_bits <= 16) {
    plan.narrow = true;
    plan.colour_shift = grow < colour_room ? grow : colour_room;
    plan.weight_shift = grow - plan.colour_shift;
    plan.hides = true;
    plan.hidden_shift = -plan.colour_shift;
    return plan;
  }
  plan.dropped_bits = dropped;
  plan.bias = nearest && dropped > 0 ? std::uint32_t{1} << (dropped - 1) : 0;
  if (largest_product + plan.bias > std::int64_t{0xFFFFFFFF}) return none("products are wider than 32 bits");
  plan.carries = plan.largest_sum > std::uint32_t{1} << 24;
  // Both factors are positive words of 16 bits, and the largest valid sum is below half of the lane's range.
  plan.hides = weight_bits <= 15;
  plan.hidden_unit = std::max({0, sheet_bits - 15, colour_bits + 1 - dropped});
  plan.hidden_shift = dropped + plan.hidden_unit - 15;
  return plan;
}

}  // namespace fastsplat::cmodel::fast
