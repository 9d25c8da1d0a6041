// SPDX-License-Identifier: Apache-2.0
// Real numbers to the device's words: every site where the driver rounds, by name (docs/numerics.md, section 8).
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/format.hpp"

namespace fastsplat::driver {

enum class Site {
  Position,       ///< a projected centre, image pixels
  Depth,          ///< depth of a centre behind the first slab boundary, kernel units
  Boundary,       ///< depth of a slab boundary behind the first one, kernel units
  Whole,          ///< a channel of a whole splat
  Carried,        ///< a channel of a whole splat plus the rounding error of the splat before
  Gaussian,       ///< opacity of a 3-D Gaussian, or a channel of its colour times its opacity
  Phi,            ///< cumulative slice weight
  Rho,            ///< support radius, pixels
  Rlut,           ///< scaled squared distance, already in words
  Scale,          ///< index.kind linear, squared, squared_elliptic: radial table steps per distance, already in words
  Cross,          ///< squared_elliptic: |B|, already in words
  Axis,           ///< separable: weight along one axis
  Footprint,      ///< blit2d: weight of a pixel
  EllipseCentre,  ///< an ellipse's projected centre, not snapped, image pixels
  EllipseTerm,    ///< an ellipse's A and C, already in words
  EllipseCross,   ///< an ellipse's |B|, already in words
  Shrink,         ///< factor on the depths of a grown kernel, One.16
  Radial,         ///< radial weight, before the largest remainders are raised
  RadialSum,      ///< sum of all radial weights, already in words
  Factor,         ///< slab factor
};

/// How a site rounds a number v: with s = v 2^frac_bits the word is floor(s), floor(s + 1/2) or ceil(s). The sum s +
/// 1/2 is a double.
struct Target {
  enum class Rounding { Down, Nearest, Up };
  enum class Overflow {
    Impossible,  ///< the caller's numbers fit by construction; asserted
    Saturates,   ///< to the nearer end of the format
  };
  Rounding rounding = Rounding::Nearest;
  Overflow overflow = Overflow::Impossible;
  cmodel::Format to{};
  double scale = 1.0;  ///< 2^frac_bits

  Target(Rounding how, Overflow beyond, const cmodel::Format& format)
      : rounding(how), overflow(beyond), to(format), scale(std::ldexp(1.0, format.frac_bits)) {}
};

Target target(Site site, const cmodel::Config& config);

struct Quantised {
  std::int64_t word = 0;
  bool saturated = false;  ///< the rounded value lay outside the format
};

/// `value` must not be NaN. (Inline, with an exact product: the driver quantises seven numbers a voxel.)
inline Quantised quantise(double value, const Target& target) {
  const double scaled = value * target.scale;
  const double word = target.rounding == Target::Rounding::Down      ? std::floor(scaled)
                      : target.rounding == Target::Rounding::Nearest ? std::floor(scaled + 0.5)
                                                                     : std::ceil(scaled);
  const auto least = static_cast<double>(target.to.min), largest = static_cast<double>(target.to.max);
  const bool outside = word < least || word > largest;
  assert(!outside || target.overflow == Target::Overflow::Saturates);
  return {.word = static_cast<std::int64_t>(
              outside && target.overflow == Target::Overflow::Saturates ? std::clamp(word, least, largest) : word),
          .saturated = outside};
}

/// quantise() where overflow is impossible; T holds the format.
template <class T>
T quantise_to(double value, const Target& target) {
  return static_cast<T>(quantise(value, target).word);
}

}  // namespace fastsplat::driver
