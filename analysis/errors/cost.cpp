// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/cost.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace fastsplat::analysis {

Cost cost(const cmodel::Config& c) {
  const double pixels = static_cast<double>(c.tile_width) * c.tile_height,
               lanes = static_cast<double>(c.lanes) * c.lanes, composited = c.composited_at_once();
  const double distance = c.radial_index_bits() + c.rlut_guard_bits + 1.0,
               weight = c.radial_int_bits + c.radial_frac_bits, colour = c.colour_bits(),
               sheet = c.sheet_int_bits + c.sheet_frac_bits, factor = c.opacity_frac_bits + 1.0,
               unit = c.composite_frac_bits + 1.0, shown = unit + c.colour_int_bits, rest = c.opacity_remainder_bits(),
               position = c.position_int_bits + c.position_frac_bits, out_word = c.pixel_int_bits + c.pixel_frac_bits;
  Cost out;
  // A table that all lanes read in the same cycle exists once per lane.
  out.storage_bits = 2.0 * c.rlut_columns * c.phases * distance        // RLUT: x and y
                     + lanes * c.radial_entries * weight               // radial table
                     + composited * c.opacity_segments * 2.0 * factor  // factor table: start and fall of a segment
                     + 2.0 * pixels * 4.0 * sheet                      // two sheet buffers
                     + pixels * 4.0 * std::max(shown, sheet);          // picture, or an X-ray's sums
  // Per splat: its position on the two axes. Per lane: q; four products and sums. Per composited pixel: the factor's
  // fall and its subtraction, four products with it, four with T, three sums and a difference. Per row: its output
  // pixels.
  out.adder_bits = 2.0 * position + lanes * (distance + 4.0 * sheet) +
                   composited * (2.0 * factor + unit + 3.0 * shown) + c.lanes * 4.0 * out_word;
  out.multiplier_bits =
      lanes * 4.0 * colour * weight + composited * (factor * rest + 4.0 * sheet * factor + unit * (unit + 3.0 * shown));
  if (c.interpolates()) {  // the fall beside each word; a product and two sums a lane
    out.storage_bits += lanes * c.radial_entries * (weight + 1.0);
    out.multiplier_bits += lanes * (weight + 1.0) * c.rlut_guard_bits;
    out.adder_bits += lanes * (2.0 * weight + 1.0);
  }
  if (c.has_ellipses()) {
    // Per record: four products of 22 and 24 bits with X and Y, then two of these sums. Per window: its polynomial from
    // the one before, a few sums per column and row, multiples by constants. Per lane: one multiple, and three words.
    const double word = c.ellipse_format().word_bits, way = 11.0 + c.position_frac_bits;
    out.multiplier_bits += 92.0 * way + way * (26.0 + way) + way * (24.0 + way);
    out.adder_bits += word * (8.0 + 14.0 * c.lanes + 3.0 * lanes);
  }
  return out;
}

nlohmann::ordered_json to_json(const Cost& cost) {
  return {{"storage_bits", cost.storage_bits},
          {"adder_bits", cost.adder_bits},
          {"multiplier_bits", cost.multiplier_bits},
          {"total", cost.total()}};
}

}  // namespace fastsplat::analysis
