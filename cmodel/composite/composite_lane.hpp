// SPDX-License-Identifier: Apache-2.0
// Unit "composite lane": pure functions that composite one pixel front to back with early termination, or add X-ray
// sums (N-6-6 to N-6-9; rtl/composite/fastsplat_composite_lane.sv).
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/composite/slab_opacity.hpp"
#include "cmodel/numbers/sites.hpp"

namespace fastsplat::cmodel {

/// State of one pixel. Mode 2: the four sums (U si.sf). Other modes: C_R, C_G, C_B (U 1+ci.tf) and T (One.tf).
using PixelState = std::array<std::uint32_t, 4>;

class CompositeLane {
 public:
  explicit CompositeLane(const Config& config)
      : freeze_below_(static_cast<std::uint32_t>(config.freeze_below)),
        light_(config),
        over_(config),
        absorbed_(config),
        sum_over_(config) {}

  bool frozen(const PixelState& pixel) const { return pixel[3] < freeze_below_; }

  /// C_c after a slab of colour c_c (Config::slab_format()) under transmittance T.
  template <class Observer>
  std::uint32_t over(std::uint32_t colour, std::uint32_t transmittance, std::int64_t slab, Observer& observer) const {
    return static_cast<std::uint32_t>(over_(colour + light_(transmittance * slab, observer), observer));
  }
  /// T after a slab of opacity a (One.tf).
  template <class Observer>
  std::uint32_t absorb(std::uint32_t transmittance, std::int64_t opacity, Observer& observer) const {
    return static_cast<std::uint32_t>(transmittance - absorbed_(transmittance * opacity, observer));
  }
  /// X_c after a sheet's sum.
  template <class Observer>
  std::uint32_t add(std::uint32_t sum, std::uint32_t sheet, Observer& observer) const {
    return static_cast<std::uint32_t>(sum_over_(std::int64_t{sum} + sheet, observer));
  }

  /// Composites one slab; returns true if the pixel was already terminated.
  template <class Observer>
  bool composite(const Slab& slab, PixelState& pixel, Observer& observer) const {
    if (frozen(pixel)) return true;
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = over(pixel[c], pixel[3], slab.colour[c], observer);
    pixel[3] = absorb(pixel[3], slab.opacity, observer);
    return false;
  }

 private:
  std::uint32_t freeze_below_;
  NarrowAt<Site::Light> light_;
  NarrowAt<Site::Over> over_;
  NarrowAt<Site::Absorbed> absorbed_;
  NarrowAt<Site::SumOver> sum_over_;
};

}  // namespace fastsplat::cmodel
