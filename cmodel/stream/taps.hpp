// SPDX-License-Identifier: Apache-2.0
// Taps: what passes each boundary of the device, in one record layout for model and RTL (docs/numerics.md, section 9).
#pragma once

#include <cstdint>
#include <span>

namespace fastsplat::cmodel {

enum class Tap : std::uint8_t {
  Snap,       ///< per splat: x0, y0, mx, my; of an ellipse x0, y0, X, Y (all but mx, my two's complement)
  Footprint,  ///< per window: P*P weights, row by row
  Sheet,      ///< per window: P*P*4 sheet words after accumulation (R,G,B,tau per pixel; 0 outside the tile)
  Composite,  ///< per dirty block (modes 4, 5: window): P*P*4 words after compositing (C_R,C_G,C_B,T, or X-ray sums)
  Pixel,      ///< per pixel: R,G,B,A
};
constexpr int kTapCount = 5;
const char* to_string(Tap tap);

/// One event: its source, place and payload. Positions are tile-relative pixels.
struct TapRecord {
  Tap tap = Tap::Snap;
  std::uint32_t tile = 0;
  std::uint32_t sheet = 0;  ///< sheet number; 0 for Pixel, which belongs to no sheet
  std::uint32_t tag = 0;    ///< splat tag; 0 for Pixel and, except in modes 4 and 5, for Composite
  std::uint64_t cycle = 0;  ///< clock cycle since reset; 0 from a device without a clock
  std::int32_t x = 0;       ///< first pixel of the window or block, or the pixel itself
  std::int32_t y = 0;
  std::span<const std::uint32_t> payload;
};

class TapSink {
 public:
  virtual ~TapSink() = default;
  virtual void on_tap(const TapRecord& record) = 0;
};

}  // namespace fastsplat::cmodel
