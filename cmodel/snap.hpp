// Unit "snap": a splat's centre onto the 1/k grid, its window's origin and phase (docs/numerics.md, section 3).
#pragma once

#include <cstdint>

#include "cmodel/config.hpp"

namespace fastsplat::cmodel {

/// One axis of a snapped splat.
struct SnappedAxis {
  std::int32_t origin = 0;  ///< first pixel strictly inside the support, tile-relative
  std::uint32_t phase = 0;  ///< window phase m, 0..k-1: the RLUT row
  bool saturated = false;   ///< the centre left the position format
};

/// `centre` is a word of S pi.pf, `rho` the support radius in 1/k pixel.
SnappedAxis snap(const Config& config, std::int32_t centre, std::uint32_t rho);

}  // namespace fastsplat::cmodel
