// Unit "compositor": slabs over pixels, front to back, with freezing; or plain sums for X-rays (docs/numerics.md,
// section 6).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cmodel/config.hpp"
#include "cmodel/counters.hpp"
#include "cmodel/sheet_buffer.hpp"
#include "cmodel/slab_opacity.hpp"
#include "cmodel/stream_layout.hpp"

namespace fastsplat::cmodel {

/// State of one pixel. Modes 0 and 1: C_R, C_G, C_B (U 1.tf) and T (One.tf). Mode 2: the four sums (U si.sf).
using PixelState = std::array<std::uint32_t, 4>;

/// One slab over one pixel; returns true where the pixel was frozen. A pure step.
bool composite(const Config& config, const Slab& slab, PixelState& pixel, Counters& counters);

/// One sheet added to the pixel's X-ray sums. A pure step.
void add(const Config& config, const SheetWord& sums, PixelState& pixel, Counters& counters);

class Compositor {
 public:
  explicit Compositor(const Config& config) : config_(config), opacity_(config) {}

  SlabOpacity& opacity() { return opacity_; }
  void begin_tile(Mode mode, int width, int height);
  Mode mode() const { return mode_; }

  /// The sheet's sums at pixel (x,y) into the picture.
  void step(const SheetWord& sums, int x, int y, Counters& counters);
  const PixelState& at(int x, int y) const { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }

 private:
  Config config_;
  SlabOpacity opacity_;
  Mode mode_ = Mode::Exponential;
  int width_ = 0;
  std::vector<PixelState> pixels_;
};

}  // namespace fastsplat::cmodel
