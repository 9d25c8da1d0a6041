// SPDX-License-Identifier: Apache-2.0
// Unit "snap": rounds a splat's centre to the 1/K grid and finds its windows' origin and phase (N-3-4, N-3-5).
#pragma once

#include <cstdint>

#include "cmodel/numbers/observers.hpp"
#include "cmodel/numbers/sites.hpp"

namespace fastsplat::cmodel {

/// One axis of a snapped splat.
struct SnappedAxis {
  std::int32_t origin = 0;  ///< first pixel strictly inside the support, tile-relative
  std::uint32_t phase = 0;  ///< window phase m, 0..K-1: the RLUT row
};

class Snap {
 public:
  explicit Snap(const Config& config) : phase_bits_(config.grid_bits()), narrow_(config) {}

  /// `centre` is a word of S pi.pf, `rho` the support radius in 1/K pixel.
  template <class Observer>
  SnappedAxis operator()(std::int32_t centre, std::uint32_t rho, Observer& observer) const {
    const std::int64_t rim = narrow_(centre, observer) - static_cast<std::int64_t>(rho);
    return {.origin = static_cast<std::int32_t>((rim >> phase_bits_) + 1),
            .phase = static_cast<std::uint32_t>(rim & ((std::int64_t{1} << phase_bits_) - 1))};
  }
  /// The same without an observer.
  SnappedAxis operator()(std::int32_t centre, std::uint32_t rho) const {
    Nothing nobody;
    return (*this)(centre, rho, nobody);
  }

 private:
  int phase_bits_;
  NarrowAt<Site::Snap> narrow_;
};

/// Snaps one centre.
inline SnappedAxis snap(const Config& config, std::int32_t centre, std::uint32_t rho) {
  return Snap(config)(centre, rho);
}

}  // namespace fastsplat::cmodel
