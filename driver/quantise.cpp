#include "driver/quantise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fastsplat::driver {
namespace {

using Rounding = Target::Rounding;
using Overflow = Target::Overflow;

/// Any 32-bit word with `frac_bits` fraction bits.
cmodel::Format signed_word(int frac_bits) { return cmodel::signed_format(32 - frac_bits, frac_bits); }
cmodel::Format unsigned_word(int frac_bits) { return cmodel::unsigned_format(32 - frac_bits, frac_bits); }

double rounded(double scaled, Rounding rounding) {
  switch (rounding) {
    case Rounding::Down:
      return std::floor(scaled);
    case Rounding::Up:
      return std::ceil(scaled);
    case Rounding::Nearest:
      break;
  }
  return std::floor(scaled + 0.5);
}

}  // namespace

Target target(Site site, const cmodel::Config& config) {
  switch (site) {
    case Site::Position:
      return {Rounding::Nearest, Overflow::Impossible, signed_word(config.position_frac_bits)};
    case Site::Depth:
    case Site::Boundary:
      return {Rounding::Nearest, Overflow::Impossible, signed_word(config.slice_phase_bits)};
    case Site::Whole:
      return {Rounding::Nearest, Overflow::Saturates, cmodel::unsigned_format(4, config.colour_frac_bits)};
    case Site::Phi:
      return {Rounding::Nearest, Overflow::Impossible, cmodel::unit_format(config.slice_frac_bits)};
    case Site::Rho:
      return {Rounding::Up, Overflow::Impossible, unsigned_word(config.phase_bits())};
    case Site::Rlut:
      return {Rounding::Nearest, Overflow::Impossible, {.min = 0, .max = config.rlut_rim()}};
    case Site::Radial:  // a word may be raised out of U wi.wf: it is saturated after that
      return {Rounding::Down, Overflow::Impossible, unsigned_word(config.radial_frac_bits)};
    case Site::RadialSum:
      return {Rounding::Nearest, Overflow::Impossible, cmodel::unsigned_format(52, 0)};
    case Site::Factor:
      return {Rounding::Nearest, Overflow::Impossible, config.factor_format()};
  }
  assert(false && "unknown site");
  return {};
}

Quantised quantise(double value, const Target& target) {
  const double word = rounded(std::ldexp(value, target.to.frac_bits), target.rounding);
  const auto least = static_cast<double>(target.to.min), largest = static_cast<double>(target.to.max);
  const bool outside = word < least || word > largest;
  assert(!outside || target.overflow == Overflow::Saturates);
  return {.word = static_cast<std::int64_t>(target.overflow == Overflow::Saturates ? std::clamp(word, least, largest)
                                                                                   : word),
          .saturated = outside};
}

}  // namespace fastsplat::driver
