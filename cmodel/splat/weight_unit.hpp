// Where weights come from: the unit of the configuration's index.kind. All have the same functions, so that whoever
// walks windows chooses once a splat (std::visit) and pays nothing a pixel:
//
// - load(table): a checked load_table of a radius set
// - load_radial(words): the radial table; units without one ignore it
// - rho(set), extent(set): 1/K pixel; Ea, pixels
// - place(set, x, y): the splat in flight, from snap()
// - window(column, row, weights, observer): the P x P weights, row by row, of the window whose first pixel is pixel
//   (column, row) of the footprint; both are multiples of P. In any order; kinds that work along scan lines use
//   additions in that order
#pragma once

#include <variant>

#include "cmodel/splat/blit_unit.hpp"
#include "cmodel/splat/linear_unit.hpp"
#include "cmodel/splat/rlut_unit.hpp"
#include "cmodel/splat/separable_unit.hpp"
#include "cmodel/splat/squared_unit.hpp"

namespace fastsplat::cmodel {

/// squared and squared_elliptic are one unit: a circle is an ellipse without B.
using WeightUnit = std::variant<RlutUnit, LinearUnit, SquaredUnit, BlitUnit, SeparableUnit>;

WeightUnit weight_unit(const Config& config);

}  // namespace fastsplat::cmodel
