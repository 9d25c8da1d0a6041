// SPDX-License-Identifier: Apache-2.0
#include "analysis/canvas.hpp"

#include <algorithm>
#include <array>

#include "analysis/bitmap_font.hpp"
#include "base/srgb.hpp"

namespace fastsplat::analysis {

Canvas::Canvas(int width, int height, Colour background)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, background) {}

void Canvas::fill(int x, int y, int width, int height, Colour colour) {
  const int right = std::min(width_, x + width);
  const int bottom = std::min(height_, y + height);
  for (int row = std::max(0, y); row < bottom; ++row) {
    for (int column = std::max(0, x); column < right; ++column) {
      pixels_[static_cast<std::size_t>(row) * width_ + column] = colour;
    }
  }
}

int Canvas::text_width(const std::string& text, int scale) {
  return text.empty() ? 0 : (static_cast<int>(text.size()) * kGlyphAdvance - 1) * scale;
}

void Canvas::text(int x, int y, const std::string& text, int scale, Colour colour, Align align) {
  if (align == Align::Centre) x -= text_width(text, scale) / 2;
  if (align == Align::Right) x -= text_width(text, scale);
  for (const char character : text) {
    const Glyph& rows = glyph(character);
    for (int row = 0; row < kGlyphHeight; ++row) {
      for (int column = 0; column < kGlyphWidth; ++column) {
        const bool dot = (rows[static_cast<std::size_t>(row)] >> (kGlyphWidth - 1 - column) & 1) != 0;
        if (dot) fill(x + column * scale, y + row * scale, scale, scale, colour);
      }
    }
    x += kGlyphAdvance * scale;
  }
}

Image Canvas::image() const {
  std::array<float, 256> linear{};
  for (int code = 0; code < 256; ++code) {
    linear[static_cast<std::size_t>(code)] = static_cast<float>(srgb_decode(code / 255.0));
  }
  Image image(width_, height_, 4);
  float* out = image.data.data();
  for (const Colour& pixel : pixels_) {
    for (const std::uint8_t code : {pixel.red, pixel.green, pixel.blue}) *out++ = linear[code];
    *out++ = 1.0f;
  }
  return image;
}

}  // namespace fastsplat::analysis
