// SPDX-License-Identifier: Apache-2.0
// Unit "compositor": the picture of a tile, into which sheets are composited or added (docs/numerics.md, section 6).
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/composite/composite_lane.hpp"
#include "cmodel/composite/slab_opacity.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

class Compositor {
 public:
  explicit Compositor(const Config& config)
      : one_(std::uint32_t{1} << config.composite_frac_bits), opacity_(config), lane_(config) {}

  SlabOpacity& opacity() { return opacity_; }
  void begin_tile(Mode mode, int width, int height) {
    mode_ = slab_mode(mode);
    width_ = width;
    pixels_.assign(static_cast<std::size_t>(width) * height, PixelState{0, 0, 0, mode == Mode::Sum ? 0 : one_});
  }

  /// Composites the sums of a sheet, or the products of one sample, at pixel (x,y).
  template <class Observer>
  void step(const SheetWord& sums, int x, int y, Counters& counters, Observer& observer) {
    PixelState& pixel = pixels_[static_cast<std::size_t>(y) * width_ + x];
    ++counters.pixels_composited;
    if (mode_ == Mode::Sum) {
      for (std::size_t c = 0; c < 4; ++c) pixel[c] = lane_.add(pixel[c], sums[c], observer);
      return;
    }
    const Slab slab =
        mode_ == Mode::Exponential ? opacity_.exponential(sums, observer) : opacity_.additive(sums, observer);
    counters.frozen_pixels += lane_.composite(slab, pixel, observer) ? 1 : 0;
  }
  /// Whether the pixel is terminated; not for mode 2.
  bool frozen(int x, int y) const { return lane_.frozen(at(x, y)); }
  const PixelState& at(int x, int y) const { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }

 private:
  std::uint32_t one_;  ///< 1.0 as One.tf
  SlabOpacity opacity_;
  CompositeLane lane_;
  Mode mode_ = Mode::Exponential;
  int width_ = 0;
  std::vector<PixelState> pixels_;
};

}  // namespace fastsplat::cmodel
