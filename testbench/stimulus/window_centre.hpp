// SPDX-License-Identifier: Apache-2.0
// The inverse of snapping: the centre of a splat whose windows begin at a pixel (docs/numerics.md, section 3).
#pragma once

#include <algorithm>
#include <cstdint>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::testbench {

/// The centre word of a splat of radius `rho` whose first window begins at pixel `origin`, in phase `phase`
/// (0..phases-1), or the nearest one in the position format.
inline std::int32_t window_centre(const cmodel::Config& config, std::uint32_t rho, std::int64_t origin,
                                  std::int64_t phase) {
  const auto format = config.position_format();
  const std::int64_t snapped = (origin - 1) * config.phases + phase + rho;
  const std::int64_t word = snapped * (std::int64_t{1} << (config.position_frac_bits - config.phase_bits()));
  return static_cast<std::int32_t>(std::clamp(word, format.min, format.max));
}

}  // namespace fastsplat::testbench
