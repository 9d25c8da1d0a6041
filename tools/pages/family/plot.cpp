// SPDX-License-Identifier: Apache-2.0
#include "tools/pages/family/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fastsplat::analysis {
namespace {

// Pixels.
constexpr double kWidth = 760, kHeight = 460, kLeft = 76, kRight = 588, kTop = 48, kBottom = 400;
constexpr const char* kInk = "#24292f";
constexpr const char* kGridColour = "#d8dee4";

/// Appearance of a series: colour safe for colour-blind readers (Okabe and Ito), dash, mark.
struct Look {
  const char* colour;
  const char* dash;
  char mark;  ///< circle, square, diamond, triangle
};
constexpr Look kLooks[] = {{"#0072b2", "none", 'c'}, {"#d55e00", "none", 's'}, {"#e69f00", "7 4", 'd'},
                           {"#009e73", "none", 't'}, {"#cc79a7", "2 4", 'c'},  {"#56b4e9", "10 3 2 3", 's'},
                           {"#000000", "4 4", 'd'},  {"#7f7f7f", "1 3", 't'}};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

/// A logarithmic axis: maps values low..high to pixels from..to.
struct Axis {
  double low = 0.0, high = 0.0, from = 0.0, to = 0.0;
  double operator()(double value) const {
    return from + (to - from) * (std::log10(value) - std::log10(low)) / (std::log10(high) - std::log10(low));
  }
};

/// Formats a tick without an exponent.
std::string number(double tick) { return tick >= 1.0 ? fmt::format("{:.0f}", tick) : fmt::format("{:g}", tick); }

/// 1, 2 and 5 times powers of ten, or only the powers if that is too many.
std::vector<double> ticks_of(const Axis& axis) {
  const bool fine = axis.high / axis.low < 2e3;
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(axis.low))); std::pow(10.0, power) <= axis.high; ++power) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double tick = step * std::pow(10.0, power);
      if ((fine || step == 1.0) && tick >= axis.low * 0.999 && tick <= axis.high * 1.001) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::string mark(char kind, double x, double y, const char* colour) {
  switch (kind) {
    case 's':
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"7\" height=\"7\" fill=\"{}\"/>\n", x - 3.5, y - 3.5,
                         colour);
    case 'd':
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 4.5l-4.5 4.5l-4.5 -4.5z\" fill=\"{}\"/>\n", x, y - 4.5, colour);
    case 't':
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 8h-9z\" fill=\"{}\"/>\n", x, y - 5.0, colour);
    default:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.8\" fill=\"{}\"/>\n", x, y, colour);
  }
}

std::string text(double x, double y, const char* anchor, const std::string& words, const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     escaped(words));
}

std::string frame(const Plot& plot, const Axis& across, const Axis& up) {
  std::string out;
  const auto x_ticks = plot.x_ticks.empty() ? ticks_of(across) : plot.x_ticks;
  for (const double tick : x_ticks) {
    out += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"{3}\"/>\n", across(tick), kTop, kBottom, kGridColour);
    out += text(across(tick), kBottom + 20, "middle", number(tick));
  }
  for (const double tick : ticks_of(up)) {
    out += fmt::format("<path d=\"M{1} {0:.1f}H{2}\" stroke=\"{3}\"/>\n", up(tick), kLeft, kRight, kGridColour);
    out += text(kLeft - 8, up(tick) + 4, "end", number(tick));
  }
  out +=
      fmt::format("<path d=\"M{0} {1}V{2}H{3}\" fill=\"none\" stroke=\"{4}\"/>\n", kLeft, kTop, kBottom, kRight, kInk);
  out += text((kLeft + kRight) / 2, kBottom + 44, "middle", plot.x_axis);
  out += text(0, 0, "middle", plot.y_axis,
              fmt::format(" transform=\"translate(20 {}) rotate(-90)\"", (kTop + kBottom) / 2).c_str());
  out += text(kLeft, 28, "start", plot.title, " font-size=\"16\" font-weight=\"bold\"");
  return out;
}

}  // namespace

std::string to_svg(const Plot& plot) {
  assert(plot.series.size() <= std::size(kLooks));
  double least_x = 1e300, most_x = 0.0, least_y = 1e300, most_y = 0.0;
  for (const PlotSeries& series : plot.series) {
    for (const auto& [x, y] : series.points) {
      least_x = std::min(least_x, x), most_x = std::max(most_x, x);
      least_y = std::min(least_y, y), most_y = std::max(most_y, y);
    }
  }
  const Axis across{least_x / 1.15, most_x * 1.15, kLeft, kRight}, up{least_y / 1.25, most_y * 1.25, kBottom, kTop};
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"{2}\" stroke-width=\"1\">\n"
      "<title>{3}</title>\n<rect width=\"{0}\" height=\"{1}\" rx=\"8\" fill=\"#ffffff\"/>\n",
      kWidth, kHeight, kInk, escaped(plot.title));
  out += frame(plot, across, up);
  for (std::size_t n = 0; n < plot.series.size(); ++n) {
    const PlotSeries& series = plot.series[n];
    const Look& look = kLooks[n];
    // The first lines are broader, so that coinciding ones stay visible.
    const double breadth = 2.0 + 0.7 * static_cast<double>(plot.series.size() - 1 - n);
    const auto stroke = fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\" stroke-dasharray=\"{}\"",
                                    look.colour, breadth, look.dash);
    out += fmt::format("<g class=\"series\">\n<title>{}</title>\n<polyline {} points=\"", escaped(series.name), stroke);
    for (const auto& [x, y] : series.points) out += fmt::format("{:.1f},{:.1f} ", across(x), up(y));
    out += "\"/>\n";
    for (const auto& [x, y] : series.points) out += mark(look.mark, across(x), up(y), look.colour);
    out += "</g>\n";
    const double y = kTop + 16 + 24 * static_cast<double>(n);
    out += fmt::format("<path d=\"M{:.1f} {:.1f}h30\" {}/>\n", kRight + 16, y, stroke);
    out += mark(look.mark, kRight + 31, y, look.colour) + text(kRight + 54, y + 4, "start", series.name);
  }
  return out + "</svg>\n";
}

}  // namespace fastsplat::analysis
