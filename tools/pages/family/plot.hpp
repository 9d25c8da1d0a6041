// Curves on two logarithmic axes, as an SVG picture: for pages of docs/. The same points give the same text everywhere.
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

/// With a ground of its own, so that it reads alike in light and dark viewers; series differ in colour, dash and mark.
std::string to_svg(const Plot& plot);

}  // namespace fastsplat::analysis
