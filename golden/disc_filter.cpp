// SPDX-License-Identifier: Apache-2.0
#include "golden/disc_filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fastsplat::golden {
namespace {

/// Area between the x axis and the circle, from 0 to x.
double under_arc(double x, double radius) {
  const double ratio = std::min(x / radius, 1.0);
  return 0.5 * (x * std::sqrt(std::max(0.0, radius * radius - x * x)) + radius * radius * std::asin(ratio));
}

/// Area of the disc within [x0,x1] x [y0,y1], all >= 0.
double disc_area(double radius, double x0, double x1, double y0, double y1) {
  if (x1 * x1 + y1 * y1 <= radius * radius) return (x1 - x0) * (y1 - y0);
  if (x0 * x0 + y0 * y0 >= radius * radius) return 0.0;
  const auto crosses = [radius](double y) { return std::sqrt(std::max(0.0, radius * radius - y * y)); };
  const double full = std::clamp(crosses(y1), x0, x1);  // up to here the arc is above y1
  const double end = std::clamp(crosses(y0), x0, x1);   // from here on it is below y0
  return (full - x0) * (y1 - y0) + under_arc(end, radius) - under_arc(full, radius) - (end - full) * y0;
}

}  // namespace

DiscFilter::DiscFilter(double diameter) {
  assert(diameter >= 0.0);
  const double wanted = diameter * diameter / 16.0;
  // Within half a pixel of the centre all weight is on the centre.
  double low = 0.5, high = 0.5 * diameter + 1.0;
  fill(diameter > 0.0 ? high : low);
  for (int i = 0; diameter > 0.0 && i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    fill(middle);
    (second_moment() < wanted ? low : high) = middle;
  }
  for (int dy = 0; dy <= reach_; ++dy) {
    int last = reach_;
    while (last >= 0 && half_row(dy)[last] == 0.0) --last;
    row_reach_.push_back(last);
  }
}

void DiscFilter::fill(double radius) {
  reach_ = static_cast<int>(std::ceil(radius - 0.5));
  weights_.assign(static_cast<std::size_t>(reach_ + 1) * (reach_ + 1), 0.0);
  double total = 0.0;
  for (int j = 0; j <= reach_; ++j) {
    for (int i = 0; i <= reach_; ++i) {
      const double x0 = std::max(0.0, i - 0.5), y0 = std::max(0.0, j - 0.5);
      // On the axes only half of the pixel (a quarter at the centre) is in the quadrant.
      const double area = disc_area(radius, x0, i + 0.5, y0, j + 0.5) * (i ? 1.0 : 2.0) * (j ? 1.0 : 2.0);
      weights_[static_cast<std::size_t>(j) * (reach_ + 1) + i] = area;
      total += area * (i ? 2.0 : 1.0) * (j ? 2.0 : 1.0);
    }
  }
  for (double& weight : weights_) weight /= total;
}

double DiscFilter::second_moment() const {
  double moment = 0.0;
  for (int j = 0; j <= reach_; ++j) {
    for (int i = 1; i <= reach_; ++i) moment += 2.0 * i * i * (j ? 2.0 : 1.0) * half_row(j)[i];
  }
  return moment;
}

}  // namespace fastsplat::golden
