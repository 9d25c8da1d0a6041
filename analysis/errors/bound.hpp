// SPDX-License-Identifier: Apache-2.0
// A proved worst case of |golden - device| at every pixel of a frame (docs/errors.md, section 3).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/pipeline/chain.hpp"
#include "analysis/pipeline/step.hpp"

namespace fastsplat::analysis {

/// Which of the device's numbers are known. Their part of the error is exact; the bound is on the rest.
enum class Known : std::uint8_t {
  Scene,     ///< golden's numbers and the configuration
  Geometry,  ///< also positions, radius sets, weights, depths and their shares: everything but colours
  Words,     ///< every word that the driver makes
};
inline constexpr std::array kLevels{Known::Scene, Known::Geometry, Known::Words};
const char* to_string(Known known);  ///< "scene", "geometry", "words"
/// The steps whose results are known.
stages::Mixture known_steps(Known known);

/// Terms of the bound by step, in the order of docs/errors.md.
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
  Classification,  ///< of densities: transfer to colour
  Factor,
  Slab,
  Composite,
  Freeze,
  Pixel,
  Transmittance,  ///< error of the device's transmittance
  SecondOrder,
};
inline constexpr std::size_t kTermCount = 18;
const char* to_string(Term term);

struct Bound {
  stages::Picture greatest;               ///< |device - golden| is at most this, value by value
  std::array<double, kTermCount> mean{};  ///< of all values, by term; they add up to about the mean of `greatest`
  Term dominant() const;
};

/// `threads` (0: all cores) never change the result.
Bound bound(const stages::Chain& chain, const stages::Picture& real, Known known, int threads = 0);
/// Bounds the distance to the picture with only the steps of `device` on the device, `known` among them: the effect of
/// some steps alone. (Not every step can stand alone: position and snap go together, and numbers that are not words are
/// rounded where words would not be.)
Bound bound(const stages::Chain& chain, const stages::Picture& real, const stages::Mixture& known,
            const stages::Mixture& device, int threads = 0);

/// The measured error against the bound.
struct BoundCheck {
  std::uint64_t values = 0, over = 0;         ///< over: values above the bound; 0 if the bound holds
  double worst = 0.0;                         ///< greatest measured / bound
  std::uint64_t pixels = 0;                   ///< with an error
  double median = 0.0, p90 = 0.0, p99 = 0.0;  ///< of bound / measured over these pixels, each by its largest channel
  double greatest_bound = 0.0, greatest_error = 0.0;
};
BoundCheck check(const Bound& bound, const stages::Picture& real, const stages::Picture& device);

}  // namespace fastsplat::analysis
