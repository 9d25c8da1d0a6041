// SPDX-License-Identifier: Apache-2.0
// Projects and quantises many splats at once, with vector instructions chosen for the processor at run time (Highway).
// Every operation is rounded as SplatQuantiser and scene::Camera write it: the words are equal.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "scene/splat_store.hpp"

namespace fastsplat::driver {

/// The view and the formats of centres.
struct CentreRule {
  std::array<double, 3> forward, right, down;  ///< world, unit
  double middle_x, middle_y;                   ///< of the picture, pixels
  double scale;                                ///< pixels per mm in the volume's centre
  double eye;                                  ///< mm from the eye to the centre; infinity: orthographic
  double unit, first;                          ///< mm per kernel unit; the first slab, kernel units
  double position_scale, position_bias;        ///< word = floor(value scale + bias)
  double depth_scale, depth_bias;
};

/// Reads from and writes to whole vectors: all arrays have room for as many more.
inline constexpr std::size_t kMoreCentres = scene::BrickSplats::kMore;
/// Positions (mm, world) to words, and pixels per mm at each.
void place_centres(const CentreRule& rule, const float* const (&position)[3], std::size_t count, std::int32_t* x,
                   std::int32_t* y, std::int32_t* depth, double* scale);

/// A splat's colour before and after rounding.
struct ColourToRound {
  std::array<float, 4> material{};       ///< emission R, G, B and extinction
  double amplitude = 0.0;                ///< factor on it
  std::array<std::uint32_t, 4> words{};  ///< floor(value scale + 1/2), at most `largest`
  double asked = 0.0;                    ///< sum of the four values
  bool saturated = false;

  bool empty() const { return (words[0] | words[1] | words[2] | words[3]) == 0; }
};
void round_colours(double scale, double largest, ColourToRound* colours, std::size_t count);

}  // namespace fastsplat::driver
