// SPDX-License-Identifier: Apache-2.0
// The weight unit of the configuration's index.kind. All units have the same functions, so that callers choose once a
// splat (std::visit), not once a pixel:
//
// - load(table): a checked load_table of a radius set
// - load_radial(words): the radial table; units without one ignore it
// - rho(set), extent(set): support radius, 1/K pixel; Ea, pixels
// - place(set, x, y): starts a splat, at the axes that snap() returned
// - window(column, row, weights, observer): the P x P weights, row by row, of the window whose first pixel is pixel
//   (column, row) of the footprint; both are multiples of P. In any order; linear and squared are fastest along scan
//   lines
#pragma once

#include <variant>

#include "cmodel/splat/blit_unit.hpp"
#include "cmodel/splat/linear_unit.hpp"
#include "cmodel/splat/rlut_unit.hpp"
#include "cmodel/splat/separable_unit.hpp"
#include "cmodel/splat/squared_unit.hpp"

namespace fastsplat::cmodel {

/// squared and squared_elliptic share a unit: a circle is an ellipse with B = 0.
using WeightUnit = std::variant<RlutUnit, LinearUnit, SquaredUnit, BlitUnit, SeparableUnit>;

WeightUnit weight_unit(const Config& config);

}  // namespace fastsplat::cmodel
