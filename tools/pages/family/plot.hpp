// SPDX-License-Identifier: Apache-2.0
// Curves on two logarithmic axes as SVG, for pages of docs/. Equal points give equal text on every machine.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace fastsplat::analysis {

struct PlotSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< x and y above 0, drawn in this order
};

struct Plot {
  std::string title, x_axis, y_axis;  ///< axes with their units
  std::vector<double> x_ticks{};      ///< empty: powers of ten
  std::vector<PlotSeries> series;     ///< at most eight
};

/// Draws its own background, so that it looks the same in light and dark viewers. Series differ in colour, dash and
/// mark.
std::string to_svg(const Plot& plot);

}  // namespace fastsplat::analysis
