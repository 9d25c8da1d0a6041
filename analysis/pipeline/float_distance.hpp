// SPDX-License-Identifier: Apache-2.0
// Step distance as floats: offsets of pixels from a centre, and their squares (docs/floats.md).
#pragma once

#include <vector>

#include "analysis/pipeline/step.hpp"

namespace fastsplat::stages {

/// From a splat's centre to a pixel along one axis, pixels; each operation rounded.
struct FloatOffset {
  double distance = 0.0, squared = 0.0;
};

/// Whether the distances of real steps are computed here: they are floats, or the centre depends on the pixel's tile.
inline bool float_distances(const Mixture& mixture) {
  return !mixture.device(Step::Distance) &&
         (mixture.floats(Step::Distance) || (mixture.floats(Step::Position) && mixture.tile_centres()));
}

/// Of pixels first..end-1 to `out`. `tile`: a tile's size along the axis.
inline void float_offsets(double centre, int first, int end, int tile, const Mixture& mixture,
                          std::vector<FloatOffset>& out) {
  const RoundToFloat& narrow = mixture.rounding(Step::Distance);
  const bool in_tile = mixture.tile_centres() && mixture.floats(Step::Position);
  out.clear();
  for (int i = first; i < end; ++i) {
    const int corner = in_tile ? i / tile * tile : 0;
    const double from = in_tile ? mixture.rounding(Step::Position)(centre - corner) : centre;
    const double distance = narrow((i - corner) - from);
    out.push_back({distance, narrow(distance * distance)});
  }
}

}  // namespace fastsplat::stages
