// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/bitmap_font.hpp"
#include "analysis/canvas.hpp"
#include "analysis/errors/attribution_report.hpp"

namespace fastsplat::analysis {
namespace {

constexpr Colour kPaper{255, 255, 255}, kInk{32, 32, 32}, kNoError{236, 236, 236};

/// Seventeen colours as distinct as possible; in pipeline order warm to cold, so that neighbouring steps look similar.
/// The eight steps of densities have paler and darker colours in between.
constexpr std::array<Colour, stages::kStepCount> kColours{
    {{166, 30, 30},  {230, 90, 40},   {245, 160, 50}, {240, 215, 60},  {190, 200, 50}, {120, 170, 50},  {50, 140, 60},
     {30, 160, 130}, {60, 190, 200},  {40, 140, 220}, {40, 80, 190},   {90, 60, 190},  {0, 0, 110},     {150, 190, 255},
     {0, 90, 90},    {170, 240, 220}, {110, 0, 80},   {250, 190, 210}, {90, 50, 0},    {255, 235, 170}, {150, 80, 210},
     {205, 90, 200}, {225, 120, 160}, {130, 80, 60},  {90, 90, 90}}};

Colour colour_of(const StepError& step) { return kColours[static_cast<std::size_t>(step.set.steps.back())]; }

}  // namespace

Image blame_map(const Attribution& a) {
  const int width = a.real.width, height = a.real.height;
  const int zoom = width >= 256 ? 1 : std::max(1, (256 + width - 1) / std::max(1, width));
  const int scale = std::clamp(width * zoom / 400, 1, 4), line = (kGlyphHeight + 4) * scale;
  std::vector<const StepError*> ruling;
  for (const StepError& step : a.steps) {
    if (step.pixels_ruled > 0.0) ruling.push_back(&step);
  }
  const int lines = static_cast<int>(ruling.size()) + 2;
  Canvas canvas(width * zoom, height * zoom + lines * line, kPaper);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int step = a.blame[static_cast<std::size_t>(y) * width + x];
      canvas.fill(x * zoom, y * zoom, zoom, zoom,
                  step < 0 ? kNoError : colour_of(a.steps[static_cast<std::size_t>(step)]));
    }
  }
  int top = height * zoom + line / 2;
  const int margin = 8 * scale;
  const auto entry = [&](Colour colour, const std::string& text) {
    canvas.fill(margin, top, line, kGlyphHeight * scale, colour);
    canvas.text(margin + line + margin, top, text, scale, kInk);
    top += line;
  };
  for (const StepError* step : ruling)
    entry(colour_of(*step), fmt::format("{}: {:.0f} % px, {:.0f} % error", step->set.name, 100.0 * step->pixels_ruled,
                                        std::abs(100.0 * step->share)));
  entry(kNoError, "no error");
  return canvas.image();
}

}  // namespace fastsplat::analysis
