#include "golden/footprint.hpp"

#include <algorithm>
#include <cmath>

namespace fastsplat::golden {

void Footprint::rasterise(const scene::Kernel& kernel, const ProjectedSplat& splat, Rows rows, int image_width) {
  spans_.clear();
  weights_.clear();
  const double radius2 = splat.radius * splat.radius;
  const double to_units2 = 1.0 / (splat.pixels_per_unit * splat.pixels_per_unit);

  const double top = std::max(std::ceil(splat.y - splat.radius), static_cast<double>(rows.first));
  const double bottom = std::min(std::floor(splat.y + splat.radius), static_cast<double>(rows.end - 1));
  for (double y = top; y <= bottom; y += 1.0) {
    const double dy = y - splat.y;
    const double half = std::sqrt(std::max(0.0, radius2 - dy * dy));
    const double left = std::max(std::ceil(splat.x - half), 0.0);
    const double right = std::min(std::floor(splat.x + half), static_cast<double>(image_width - 1));
    if (left > right) continue;

    // The rim's own pixels are decided by the kernel's strict test, which returns 0 there.
    spans_.push_back(
        {static_cast<int>(y), static_cast<int>(left), static_cast<int>(right - left) + 1, weights_.size()});
    for (double x = left; x <= right; x += 1.0) {
      const double dx = x - splat.x;
      weights_.push_back(kernel.footprint((dx * dx + dy * dy) * to_units2));
    }
  }
}

}  // namespace fastsplat::golden
