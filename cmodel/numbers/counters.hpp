// SPDX-License-Identifier: Apache-2.0
// The device's counters (docs/numerics.md, section 9). Every narrowing site that may saturate has one, so no overflow
// is silent.
#pragma once

#include <cstdint>

namespace fastsplat::cmodel {

// clang-format off
#define FASTSPLAT_COUNTERS(X)                                                            \
  X(tiles, "tiles rendered")                                                             \
  X(sheets, "sheets composited")                                                         \
  X(splats, "splat records")                                                             \
  X(windows, "P x P windows")                                                            \
  X(lanes_inside, "window pixels inside the tile")                                       \
  X(lanes_weighted, "window pixels inside the tile with a weight above 0")               \
  X(cull_blocks, "cull_block hints")                                                     \
  X(dirty_blocks, "P x P blocks composited, over all sheets")                            \
  X(pixels_composited, "pixels visited by the compositor")                               \
  X(frozen_pixels, "pixel visits skipped because the pixel was terminated")              \
  X(snap_saturated, "centres outside the position format after snapping")                \
  X(product_saturated, "colour x weight products above the sheet format")                \
  X(sheet_saturated, "sheet sums clamped to the largest word")                           \
  X(opacity_saturated, "slab opacities or colours clamped to 1.0")                       \
  X(composite_saturated, "composited colours or X-ray sums clamped to the largest word") \
  X(pixel_saturated, "output words clamped to the largest word")
// clang-format on

struct Counters {
#define X(name, meaning) std::uint64_t name = 0;
  FASTSPLAT_COUNTERS(X)
#undef X

  Counters& operator+=(const Counters& other) {
#define X(name, meaning) name += other.name;
    FASTSPLAT_COUNTERS(X)
#undef X
    return *this;
  }
  bool operator==(const Counters&) const = default;

  /// visit(name, value, meaning) in the order above.
  template <class Visit>
  void for_each(Visit visit) const {
#define X(name, meaning) visit(#name, name, meaning);
    FASTSPLAT_COUNTERS(X)
#undef X
  }
};

}  // namespace fastsplat::cmodel
