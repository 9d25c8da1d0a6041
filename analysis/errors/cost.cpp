// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/cost.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace fastsplat::analysis {
namespace {

/// Widths, docs/errors.md, section 5.
struct WordBits {
  double distance, weight, colour, sheet, factor, unit, shown, rest, position, out_word;

  explicit WordBits(const cmodel::Config& c)
      : distance(c.radial_index_bits() + c.rlut_guard_bits + 1.0),
        weight(c.radial_int_bits + c.radial_frac_bits),
        colour(c.colour_bits()),
        sheet(c.sheet_int_bits + c.sheet_frac_bits),
        factor(c.opacity_frac_bits + 1.0),
        unit(c.composite_frac_bits + 1.0),
        shown(unit + c.colour_int_bits),
        rest(c.opacity_remainder_bits()),
        position(c.position_int_bits + c.position_frac_bits),
        out_word(c.pixel_int_bits + c.pixel_frac_bits) {}
};

}  // namespace

EventArithmetic event_arithmetic(const cmodel::Config& c) {
  const WordBits w(c);
  // A splat: its position on the two axes. A lane: q; four products and sums. A composited pixel: the factor's fall and
  // its subtraction, four products with it, four with T, three sums and a difference.
  EventArithmetic out{.splat = {.adder_bits = 2.0 * w.position},
                      .window = {},
                      .weight = {.adder_bits = w.distance},
                      .product = {.multiplier_bits = 4.0 * w.colour * w.weight},
                      .sum = {.adder_bits = 4.0 * w.sheet},
                      .composited = {.adder_bits = 2.0 * w.factor + w.unit + 3.0 * w.shown,
                                     .multiplier_bits = w.factor * w.rest + 4.0 * w.sheet * w.factor +
                                                        w.unit * (w.unit + 3.0 * w.shown)},
                      .output = {.adder_bits = 4.0 * w.out_word}};
  if (c.interpolates())  // a product and two sums
    out.weight = out.weight + Arithmetic{2.0 * w.weight + 1.0, (w.weight + 1.0) * c.rlut_guard_bits};
  if (c.has_ellipses()) {
    // A record: four products of 22 and 24 bits with X and Y, then two of these sums. A window: its polynomial from the
    // one before, a few sums a column and row, multiples by constants. A lane: one multiple, and three words.
    const double word = c.ellipse_format().word_bits, way = 11.0 + c.position_frac_bits;
    out.splat.multiplier_bits += 92.0 * way + way * (26.0 + way) + way * (24.0 + way);
    out.window.adder_bits += word * (8.0 + 14.0 * c.lanes);
    out.weight.adder_bits += word * 3.0;
  }
  return out;
}

Memories memories(const cmodel::Config& c) {
  const WordBits w(c);
  const double pixels = static_cast<double>(c.tile_width) * c.tile_height;
  return {.rlut_bits = static_cast<double>(c.rlut_columns) * c.phases * w.distance,
          // with interpolation, the fall beside each word
          .radial_bits = c.radial_entries * (w.weight + (c.interpolates() ? w.weight + 1.0 : 0.0)),
          .factor_bits = c.opacity_segments * 2.0 * w.factor,  // start and fall of a segment
          .sheet_bits = 2.0 * pixels * 4.0 * w.sheet,
          .picture_bits = pixels * 4.0 * std::max(w.shown, w.sheet)};
}

Cost cost(const cmodel::Config& c) {
  const double lanes = static_cast<double>(c.lanes) * c.lanes, composited = c.composited_at_once();
  const Memories m = memories(c);
  const EventArithmetic one = event_arithmetic(c);
  const Arithmetic all = one.splat + one.window + (one.weight + one.product + one.sum) * lanes +
                         one.composited * composited + one.output * c.lanes;
  return {.storage_bits =
              2.0 * m.rlut_bits + lanes * m.radial_bits + composited * m.factor_bits + m.sheet_bits + m.picture_bits,
          .adder_bits = all.adder_bits,
          .multiplier_bits = all.multiplier_bits};
}

nlohmann::ordered_json to_json(const Cost& cost) {
  return {{"storage_bits", cost.storage_bits},
          {"adder_bits", cost.adder_bits},
          {"multiplier_bits", cost.multiplier_bits},
          {"total", cost.total()}};
}

}  // namespace fastsplat::analysis
