// A proved worst case of |golden - device| at every pixel of a frame (docs/errors.md, section 3).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/pipeline/chain.hpp"
#include "analysis/pipeline/step.hpp"

namespace fastsplat::analysis {

/// What is known of the device's numbers; the known part of the error is exact, the bound is on the rest.
enum class Known : std::uint8_t {
  Scene,     ///< golden's numbers and the configuration
  Geometry,  ///< also places, radius sets, weights, depths and their shares: everything but colours
  Words,     ///< every word that the driver makes
};
inline constexpr std::array kLevels{Known::Scene, Known::Geometry, Known::Words};
const char* to_string(Known known);  ///< "scene", "geometry", "words"
/// The steps whose results are known.
stages::Mixture known_steps(Known known);

/// What the bound consists of, by step; in the order of docs/errors.md.
enum class Term : std::uint8_t {
  Known,  ///< the exact part
  Place,
  Radius,
  Lookup,  ///< distance and index
  Weight,
  Emission,
  Depth,  ///< depth and phi
  Share,
  Product,
  Sheet,
  Factor,
  Slab,
  Composite,
  Freeze,
  Pixel,
  Transmittance,  ///< that the device's differs from the real one
  SecondOrder,
};
inline constexpr std::size_t kTermCount = 17;
const char* to_string(Term term);

struct Bound {
  stages::Picture greatest;               ///< |device - golden| is at most this, value by value
  std::array<double, kTermCount> mean{};  ///< of all values, by term; they add up to about the mean of `greatest`
  Term dominant() const;
};

/// Throws UserError (Usage) where nothing is proved of such frames: of ellipses, of every sample, of densities.
void check_bounded(const stages::Chain& chain);

/// `threads` (0: all cores) never change the result.
Bound bound(const stages::Chain& chain, const stages::Picture& real, Known known, int threads = 0);
/// The same on the distance to the picture of which only the steps of `device` are the device's, `known` among them:
/// what some steps can do alone. (Position and snap go together, and numbers that are no words are rounded where words
/// would not be: not every step can stand alone.)
Bound bound(const stages::Chain& chain, const stages::Picture& real, const stages::Mixture& known,
            const stages::Mixture& device, int threads = 0);

/// How near the measured error comes.
struct BoundCheck {
  std::uint64_t values = 0, over = 0;         ///< over: measured more than the bound; a bound that is one has none
  double worst = 0.0;                         ///< greatest measured / bound
  std::uint64_t pixels = 0;                   ///< with an error
  double median = 0.0, p90 = 0.0, p99 = 0.0;  ///< of bound / measured, of the largest channel each, over these pixels
  double greatest_bound = 0.0, greatest_error = 0.0;
};
BoundCheck check(const Bound& bound, const stages::Picture& real, const stages::Picture& device);

}  // namespace fastsplat::analysis
