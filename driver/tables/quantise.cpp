// SPDX-License-Identifier: Apache-2.0
#include "driver/tables/quantise.hpp"

#include <cassert>

#include "cmodel/numbers/index_set.hpp"

namespace fastsplat::driver {
namespace {

using Rounding = Target::Rounding;
using Overflow = Target::Overflow;

/// Any 32-bit word with `frac_bits` fraction bits.
cmodel::Format signed_word(int frac_bits) { return cmodel::signed_format(32 - frac_bits, frac_bits); }
cmodel::Format unsigned_word(int frac_bits) { return cmodel::unsigned_format(32 - frac_bits, frac_bits); }

/// U 4.cf
cmodel::Format whole_word(const cmodel::Config& config) { return cmodel::unsigned_format(4, config.colour_frac_bits); }

/// Whether the snap still has bits to round half up. Then floor(x 2^pf) and the snap together round x once, half up.
/// Rounded here as well, a splat would move by 2^-(pf+1) pixel on average (N-8-19).
bool rounded_by_the_snap(const cmodel::Config& config) {
  return config.grid_bits() < config.position_frac_bits &&
         config.rounding_snap == static_cast<int>(cmodel::Rounding::RND);
}

}  // namespace

Target target(Site site, const cmodel::Config& config) {
  switch (site) {
    case Site::Position:
      return {rounded_by_the_snap(config) ? Rounding::Down : Rounding::Nearest, Overflow::Impossible,
              signed_word(config.position_frac_bits)};
    case Site::EllipseCentre:
      return {Rounding::Nearest, Overflow::Impossible, signed_word(config.position_frac_bits)};
    case Site::EllipseTerm:  // up, like Scale; |B| towards 0, like Cross
      return {Rounding::Up, Overflow::Impossible, cmodel::unsigned_format(cmodel::kEllipseTermBits, 0)};
    case Site::EllipseCross:
      return {Rounding::Down, Overflow::Impossible, cmodel::unsigned_format(cmodel::kEllipseTermBits + 1, 0)};
    case Site::Shrink:
      return {Rounding::Nearest, Overflow::Saturates,
              cmodel::Format{.min = 1, .max = std::int64_t{1} << 16, .frac_bits = 16}};
    case Site::Depth:
    case Site::Boundary:
      return {Rounding::Nearest, Overflow::Impossible, signed_word(config.slice_phase_bits)};
    case Site::Whole:
      return {Rounding::Nearest, Overflow::Saturates, whole_word(config)};
    case Site::Carried:  // the rest is carried to the next splat
      return {Rounding::Down, Overflow::Saturates, whole_word(config)};
    case Site::Gaussian:
      return {Rounding::Nearest, Overflow::Saturates, config.colour_format()};
    case Site::Phi:
      return {Rounding::Nearest, Overflow::Impossible, cmodel::unit_format(config.slice_frac_bits)};
    case Site::Rho:
      return {Rounding::Up, Overflow::Impossible, unsigned_word(config.grid_bits())};
    case Site::Rlut:
      return {Rounding::Nearest, Overflow::Impossible, cmodel::Format{.min = 0, .max = config.rlut_rim()}};
    case Site::Scale:  // up: pixels beyond the edge have no weight
      return {Rounding::Up, Overflow::Saturates, cmodel::Format{.min = 0, .max = cmodel::kLargestScale}};
    case Site::Cross:  // towards 0: 4 A C >= B^2 stays true
      return {Rounding::Down, Overflow::Saturates, cmodel::Format{.min = 0, .max = 2 * cmodel::kLargestScale}};
    case Site::Axis:
      return {Rounding::Nearest, Overflow::Saturates, config.axis_weight_format()};
    case Site::Footprint:
      return {Rounding::Nearest, Overflow::Saturates, config.weight_format()};
    case Site::Radial:  // raised words may leave U wi.wf; radial_table() saturates them
      return {Rounding::Down, Overflow::Impossible, unsigned_word(config.radial_frac_bits)};
    case Site::RadialSum:
      return {Rounding::Nearest, Overflow::Impossible, cmodel::unsigned_format(52, 0)};
    case Site::Factor:
      return {Rounding::Nearest, Overflow::Impossible, config.factor_format()};
  }
  assert(false && "unknown site");
  return {Rounding::Nearest, Overflow::Impossible, {}};
}

}  // namespace fastsplat::driver
