// Real numbers to the device's words: every place where the driver rounds, by name (docs/numerics.md, section 8).
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
  Depth,          ///< of a centre behind the first slab boundary, kernel units
  Boundary,       ///< between two slabs, behind the first one, kernel units
  Whole,          ///< a channel of a whole splat
  Carried,        ///< a channel of a whole splat and what the splat before left
  Gaussian,       ///< opacity of a 3-D Gaussian, or a channel of its colour times that
  Phi,            ///< cumulative slice weight
  Rho,            ///< support radius, pixels
  Rlut,           ///< scaled squared distance, in words already
  Scale,          ///< index.kind linear, squared, squared_elliptic: radial table steps per distance, in words already
  Cross,          ///< squared_elliptic: B without its sign, in words already
  Axis,           ///< separable: weight along one axis
  Footprint,      ///< blit2d: weight of a pixel
  EllipseCentre,  ///< a projected centre that no device snaps, image pixels
  EllipseTerm,    ///< an ellipse's A and C, in words already
  EllipseCross,   ///< its B without the sign, in words already
  Shrink,         ///< of a kernel's depths where it has grown: One.16
  Radial,         ///< radial weight, before the largest remainders are raised
  RadialSum,      ///< of all radial weights, in words already
  Factor,         ///< slab factor
};

/// What a site makes of a number v: with s = v 2^frac_bits the word is floor(s), floor(s + 1/2) or ceil(s), where s +
/// 1/2 is rounded as a double is.
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

/// `value` is a number. (Inline, and by a product that is exact: the driver quantises seven numbers a voxel.)
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
