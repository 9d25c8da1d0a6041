// Real numbers to the device's words: every place where the driver rounds, by name (docs/numerics.md, section 8).
#pragma once

#include <cstdint>

#include "cmodel/config.hpp"
#include "cmodel/format.hpp"

namespace fastsplat::driver {

enum class Site {
  Position,   ///< a projected centre, image pixels
  Depth,      ///< of a centre behind the first slab boundary, kernel units
  Boundary,   ///< between two slabs, behind the first one, kernel units
  Whole,      ///< a channel of a whole splat
  Phi,        ///< cumulative slice weight
  Rho,        ///< support radius, pixels
  Rlut,       ///< scaled squared distance, in words already
  Radial,     ///< radial weight, before the largest remainders are raised
  RadialSum,  ///< of all radial weights, in words already
  Factor,     ///< slab factor
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
};

Target target(Site site, const cmodel::Config& config);

struct Quantised {
  std::int64_t word = 0;
  bool saturated = false;  ///< the rounded value lay outside the format
};

/// `value` is a number.
Quantised quantise(double value, const Target& target);

/// quantise() where overflow is impossible; T holds the format.
template <class T>
T quantise_to(double value, const Target& target) {
  return static_cast<T>(quantise(value, target).word);
}

}  // namespace fastsplat::driver
