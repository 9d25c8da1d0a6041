// SPDX-License-Identifier: Apache-2.0
// Which pixels a quantised splat may touch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cmodel/numbers/window_geometry.hpp"
#include "cmodel/splat/snap.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "driver/tiles/tile_bins.hpp"

namespace fastsplat::driver {

/// The snapped window of a splat in image pixels. The image may be larger than a tile, so positions get room;
/// the tile's origin is a whole number of pixels, so the window is the one the device finds.
class Windows {
 public:
  Windows(const cmodel::Config& config, const RadiusSets& sets) : config_(config), sets_(sets), snap_(wide(config)) {
    for (std::uint32_t set = 0; set < sets.size(); ++set)
      extents_.push_back(cmodel::window_geometry(config, sets_.rho(set)));
  }
  cmodel::SnappedAxis snapped(std::int32_t centre, std::uint32_t set) const {
    cmodel::Nothing nobody;
    return snap_(centre, sets_.rho(set), nobody);
  }
  /// The box of all windows of an ellipse.
  Extent operator()(const QuantisedSplat& splat, const cmodel::EllipseShape& shape) const {
    const std::int32_t x = splat.x >> config_.position_frac_bits, y = splat.y >> config_.position_frac_bits;
    Extent out{.x0 = x, .x1 = x, .y0 = y, .y1 = y, .window_end = y};  // empty
    bool first = true;
    for (const EllipseSpan& span : EllipseSpans(config_, shape, splat.x, splat.y)) {
      const std::int32_t top = y + span.windows.top;
      const std::int32_t end = top + static_cast<std::int32_t>(span.windows.rows) * config_.lanes;
      const Extent one{x + span.windows.left, x + span.right, top, y + span.bottom, end};
      out = first ? one
                  : Extent{std::min(out.x0, one.x0), std::max(out.x1, one.x1), std::min(out.y0, one.y0),
                           std::max(out.y1, one.y1), std::max(out.window_end, one.window_end)};
      first = false;
    }
    return out;
  }
  Extent operator()(const QuantisedSplat& splat) const {
    const auto extent = static_cast<std::int32_t>(extents_[splat.set].extent);
    const std::int32_t x0 = snapped(splat.x, splat.set).origin, y0 = snapped(splat.y, splat.set).origin;
    return {x0, x0 + extent, y0, y0 + extent, y0 + static_cast<std::int32_t>(extents_[splat.set].padded)};
  }

  /// Sides of the widest and the narrowest footprint, in pixels, rounded up to whole windows.
  std::int32_t widest() const {
    return static_cast<std::int32_t>(std::ranges::max(extents_, {}, &cmodel::WindowGeometry::padded).padded);
  }
  std::int32_t narrowest() const {
    return static_cast<std::int32_t>(std::ranges::min(extents_, {}, &cmodel::WindowGeometry::padded).padded);
  }

 private:
  static cmodel::Config wide(cmodel::Config config) {
    config.position_int_bits = 30 - config.position_frac_bits;
    return config;
  }
  const cmodel::Config config_;
  const RadiusSets& sets_;
  cmodel::Snap snap_;
  std::vector<cmodel::WindowGeometry> extents_;  ///< per set
};

}  // namespace fastsplat::driver
