// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/bitmap_font.hpp"
#include "analysis/canvas.hpp"
#include "analysis/colour_map.hpp"
#include "analysis/compare.hpp"
#include "analysis/error_values.hpp"

namespace fastsplat::analysis {
namespace {

constexpr Colour kPaper{255, 255, 255};
constexpr Colour kInk{32, 32, 32};
constexpr int kLeastWidth = 256;  // required by the legend

struct Tick {
  double position;  ///< 0 left end of the bar, 1 right end
  std::string label;
};

struct Legend {
  std::string title;
  std::function<Colour(double)> colour;  ///< of a bar position
  std::vector<Tick> ticks;
  std::size_t anchor = 0;  ///< the tick that always has a label
};

/// The errors of a picture, one per pixel, and how the map is laid out.
class Map {
 public:
  Map(const Image& ref, const Image& test, const CompareOptions& options)
      : bits_(options.lsb_bits), width_(ref.width), height_(ref.height) {
    check_comparable(ref, test, options);
    errors_ = worst_channel(error_values(ref, test, options), ref.channels);
    for (const double error : errors_) {
      if (std::isnan(error)) {
        ++nonfinite_;
      } else {
        largest_ = std::max(largest_, std::abs(error));
      }
    }
  }

  double largest() const { return largest_; }
  std::string unit() const { return fmt::format("LSB{}", bits_); }

  template <typename Colouring>
  Image draw(const Colouring& colour_of, const Legend& legend) const {
    // Enlarged to the legend's width, but a narrow strip not beyond a screen's height.
    const int zoom = width_ == 0 || width_ >= kLeastWidth
                         ? 1
                         : std::max(1, std::min((kLeastWidth + width_ - 1) / width_, 1024 / std::max(1, height_)));
    const int width = std::max(kLeastWidth, width_ * zoom);
    const int scale = std::clamp(width / 400, 1, 4);
    Canvas canvas(width, height_ * zoom + legend_height(scale), kPaper);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const double error = errors_[static_cast<std::size_t>(y) * width_ + x];
        canvas.fill(x * zoom, y * zoom, zoom, zoom, std::isnan(error) ? kNonfiniteColour : colour_of(error));
      }
    }
    draw_legend(canvas, height_ * zoom, scale, legend);
    return canvas.image();
  }

 private:
  static int line_height(int scale) { return (kGlyphHeight + 3) * scale; }
  int legend_height(int scale) const { return (nonfinite_ > 0 ? 62 : 46) * scale; }

  void draw_legend(Canvas& canvas, int top, int scale, const Legend& legend) const {
    canvas.fill(0, top, canvas.width(), scale, kInk);
    const int margin = 12 * scale;
    const int bar_width = canvas.width() - 2 * margin;
    int y = top + 6 * scale;
    canvas.text(margin, y, legend.title, scale, kInk);
    const std::string largest =
        largest_ < 1000 ? fmt::format("max {:.3g}", largest_) : fmt::format("max {:.0f}", largest_);
    canvas.text(margin + bar_width, y, largest, scale, kInk, Align::Right);
    y += line_height(scale) + scale;
    const int bar_height = 10 * scale;
    canvas.fill(margin - 1, y - 1, bar_width + 2, bar_height + 2, kInk);
    for (int i = 0; i < bar_width; ++i) {
      canvas.fill(margin + i, y, 1, bar_height, legend.colour((i + 0.5) / bar_width));
    }
    draw_ticks(canvas, margin, y + bar_height, bar_width, scale, legend);
    if (nonfinite_ > 0) {
      y += bar_height + 8 * scale + line_height(scale);
      canvas.fill(margin, y, kGlyphHeight * scale, kGlyphHeight * scale, kNonfiniteColour);
      const std::string label = fmt::format("not finite: {} pixel{}", nonfinite_, nonfinite_ == 1 ? "" : "s");
      canvas.text(margin + 10 * scale, y, label, scale, kInk);
    }
  }

  /// Every tick, or every 2nd, 4th, ... counted from the anchor, so that no label touches the next.
  static void draw_ticks(Canvas& canvas, int left, int top, int width, int scale, const Legend& legend) {
    struct Placed {
      int centre, start, end;
      const std::string* label;
    };
    std::vector<Placed> placed;
    for (std::size_t stride = 1;; stride *= 2) {
      placed.clear();
      bool fits = true;
      for (std::size_t t = legend.anchor % stride; t < legend.ticks.size(); t += stride) {
        const Tick& tick = legend.ticks[t];
        const int label = Canvas::text_width(tick.label, scale);
        const int centre = left + static_cast<int>(std::lround(tick.position * (width - 1)));
        const int start = std::clamp(centre - label / 2, 2 * scale, canvas.width() - label - 2 * scale);
        fits = fits && (placed.empty() || start >= placed.back().end + 2 * kGlyphAdvance * scale);
        placed.push_back({centre, start, start + label, &tick.label});
      }
      if (fits) break;
    }
    for (const auto& [centre, start, end, label] : placed) {
      canvas.fill(centre - scale / 2, top, scale, 3 * scale, kInk);
      canvas.text(start, top + 5 * scale, *label, scale, kInk);
    }
  }

  int bits_, width_, height_;
  std::vector<double> errors_;
  std::size_t nonfinite_ = 0;
  double largest_ = 0;
};

/// The end of a scale with round numbers inside, 1, 2, 3, 4, 5, 6 or 8 times a power of ten. It divides evenly into
/// `steps`.
struct Scale {
  double end;
  int steps;
};

Scale scale_for(double value) {
  double decade = 1;
  while (10 * decade <= value) decade *= 10;
  static constexpr std::array<Scale, 7> kEnds{{{1, 2}, {2, 2}, {3, 3}, {4, 4}, {5, 5}, {6, 3}, {8, 4}}};
  for (const auto& [end, steps] : kEnds) {
    if (end * decade >= value) return {end * decade, steps};
  }
  return {10 * decade, 2};
}

}  // namespace

Image lsb_map(const Image& ref, const Image& test, const CompareOptions& options) {
  const Map map(ref, test, options);
  const auto [range, steps] = scale_for(std::max(1.0, map.largest()));
  Legend legend;
  legend.title = "TEST - REF in " + map.unit();
  legend.colour = [](double position) { return diverging_colour(2 * position - 1); };
  legend.anchor = static_cast<std::size_t>(steps);
  for (int i = -steps; i <= steps; ++i) {
    const double value = range * i / steps;
    legend.ticks.push_back({0.5 + 0.5 * i / steps, i == 0 ? "0" : fmt::format("{:+g}", value)});
  }
  return map.draw([end = range](double error) { return diverging_colour(error / end); }, legend);
}

Image heat_map(const Image& ref, const Image& test, const CompareOptions& options) {
  constexpr int kLowest = -4;  // 2^-4 LSB and below are black
  const Map map(ref, test, options);
  const int highest = static_cast<int>(std::ceil(std::log2(std::max(1.0, map.largest()))));
  const double octaves = highest - kLowest;
  Legend legend;
  legend.title = "abs(TEST - REF) in " + map.unit();
  legend.colour = heat_colour;
  legend.anchor = -kLowest;  // 1 LSB
  for (int octave = kLowest; octave <= highest; ++octave) {
    const std::string label =
        octave < 0 ? fmt::format("1/{}", 1 << -octave) : fmt::format("{:g}", std::ldexp(1.0, octave));
    legend.ticks.push_back({(octave - kLowest) / octaves, label});
  }
  return map.draw(
      [octaves](double error) {
        return error == 0 ? heat_colour(0) : heat_colour((std::log2(std::abs(error)) - kLowest) / octaves);
      },
      legend);
}

}  // namespace fastsplat::analysis
