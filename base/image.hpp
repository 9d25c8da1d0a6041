// SPDX-License-Identifier: Apache-2.0
// A floating-point image: golden's result, or a decoded file.
#pragma once

#include <cstddef>
#include <vector>

namespace fastsplat {

/// Row-major, y downwards, channels interleaved. Rendered images are RGBA, premultiplied, linear, 1.0 = full.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 4;
  std::vector<float> data;  ///< width*height*channels

  Image() = default;
  Image(int w, int h, int c = 4) : width(w), height(h), channels(c), data(static_cast<std::size_t>(w) * h * c, 0.0f) {}
  float* pixel(int x, int y) { return &data[(static_cast<std::size_t>(y) * width + x) * channels]; }
  const float* pixel(int x, int y) const { return &data[(static_cast<std::size_t>(y) * width + x) * channels]; }
  bool operator==(const Image&) const = default;
};

}  // namespace fastsplat
