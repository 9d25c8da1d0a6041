// SPDX-License-Identifier: Apache-2.0
// Weights of an ellipse's pixels by vector instructions (Highway): cmodel/splat/ellipse_unit.hpp for whole rectangles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/ellipse_unit.hpp"

namespace fastsplat::cmodel::fast {

/// The radial table as the kernel reads it. q is shifted left in 64-bit lanes, so that it wraps as its word does. The
/// upper half holds the sign and, shifted right, the table's index.
struct EllipseTable {
  std::vector<std::uint32_t> weights;  ///< N weights, shifted left as those of circles, then a 0 for all indices beyond
  std::uint32_t heaviest = 0;          ///< largest weight, unshifted
  int above = 0;                       ///< bits of a lane above the word
  int index_shift = 0;                 ///< right shift of a lane's upper half
};

/// Made of `radial`, unshifted. Empty if the configuration has no ellipses or an index may exceed half a lane.
std::optional<EllipseTable> ellipse_table(const Config& config, std::span<const std::uint32_t> radial,
                                          int weight_shift);

/// A rectangle of a record's pixels, counted from its first one.
struct EllipseBox {
  std::int32_t column = 0, row = 0, columns = 0, rows = 0;
};

/// Writes the weights of `box` to `out`, in rows of pitch_of(columns) words, 0 after the columns. Returns how many are
/// above 0.
std::uint32_t weigh(const EllipseTable& table, const EllipseCoefficients& f, const EllipseBox& box, std::uint16_t* out);

}  // namespace fastsplat::cmodel::fast
