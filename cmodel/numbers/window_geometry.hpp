// SPDX-License-Identifier: Apache-2.0
// The size of a radius set's footprint, which follows from its support radius (N-3-3).
#pragma once

#include <cstdint>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

/// One side of the footprint.
struct WindowGeometry {
  std::uint32_t extent = 0;   ///< E = ceil(2 rho / K): pixels that can lie inside the support
  std::uint32_t padded = 0;   ///< Ea: E up to the next multiple of P, pixels; columns of the set in the RLUT
  std::uint32_t windows = 0;  ///< Ea / P
};

/// `rho` in 1/K pixel.
inline WindowGeometry window_geometry(const Config& config, std::uint32_t rho) {
  const auto k = static_cast<std::uint64_t>(config.grid()), lanes = static_cast<std::uint64_t>(config.lanes);
  const std::uint64_t extent = (2ULL * rho + k - 1) / k, windows = (extent + lanes - 1) / lanes;
  return {.extent = static_cast<std::uint32_t>(extent),
          .padded = static_cast<std::uint32_t>(windows * lanes),
          .windows = static_cast<std::uint32_t>(windows)};
}

}  // namespace fastsplat::cmodel
