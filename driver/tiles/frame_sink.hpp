// SPDX-License-Identifier: Apache-2.0
// Gathers finished tiles into a frame. Tiles are disjoint, so devices may deliver in parallel.
#pragma once

#include <algorithm>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/frame.hpp"

namespace fastsplat::driver {

class FrameSink final : public cmodel::PixelSink {
 public:
  FrameSink(const cmodel::Config& config, int width, int height) {
    frame_.width = width;
    frame_.height = height;
    frame_.int_bits = config.pixel_int_bits;
    frame_.frac_bits = config.pixel_frac_bits;
    frame_.config_hash = cmodel::config_hash(config);
    frame_.words.assign(static_cast<std::size_t>(width) * height * 4, 0);
  }
  void on_tile(cmodel::TilePixels&& tile) override {
    const auto row_words = static_cast<std::size_t>(tile.width) * 4;
    for (int y = 0; y < tile.height; ++y) {
      std::copy_n(&tile.words[static_cast<std::size_t>(y) * row_words], row_words, frame_.pixel(tile.x, tile.y + y));
    }
  }
  cmodel::Frame take() { return std::move(frame_); }

 private:
  cmodel::Frame frame_;
};

}  // namespace fastsplat::driver
