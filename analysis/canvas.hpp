// SPDX-License-Identifier: Apache-2.0
// A small sRGB drawing surface for maps and their legends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/image.hpp"

namespace fastsplat::analysis {

/// 8-bit sRGB, as palettes are specified.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

enum class Align { Left, Centre, Right };

class Canvas {
 public:
  Canvas(int width, int height, Colour background);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Clipped to the canvas.
  void fill(int x, int y, int width, int height, Colour colour);
  /// `x` is the text's left edge, centre or right edge; each dot of the font is scale x scale pixels.
  void text(int x, int y, const std::string& text, int scale, Colour colour, Align align = Align::Left);

  static int text_width(const std::string& text, int scale);

  /// Opaque linear RGBA, whose sRGB encoding gives the drawn bytes back.
  Image image() const;

 private:
  int width_, height_;
  std::vector<Colour> pixels_;
};

}  // namespace fastsplat::analysis
