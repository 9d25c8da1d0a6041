// SPDX-License-Identifier: Apache-2.0
#include "golden/splat/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "scene/textured_splats.hpp"

namespace fastsplat::golden {

// The canonical radius of an ellipse with shape S, by completing the square along a row:
//     q = A dx^2 + B dx dy + C dy^2 = (aspect * (dx - slope*dy)^2 + dy^2) / yy,
//     slope = xy/yy, aspect = yy^2/det,
// A row's pixels lie around slope*dy. A circle has slope 0 and aspect 1, and gives q = (dx^2 + dy^2) / radius^2, bit
// for bit.
void Footprint::rasterise(const scene::Kernel& kernel, const ProjectedSplat& splat, Rows rows, int image_width) {
  spans_.clear();
  std::size_t used = 0;
  const scene::ScreenShape& shape = splat.shape;
  const double slope = shape.xy / shape.yy;
  const double aspect = shape.yy / (shape.xx - slope * shape.xy);
  const double radius2 = splat.reach_y * splat.reach_y;
  const double to_units2 = 1.0 / shape.yy;

  const double top = std::max(std::ceil(splat.y - splat.reach_y), static_cast<double>(rows.first));
  const double bottom = std::min(std::floor(splat.y + splat.reach_y), static_cast<double>(rows.end - 1));
  for (double y = top; y <= bottom; y += 1.0) {
    const double dy = y - splat.y;
    const double middle = splat.x + slope * dy;
    const double half = std::sqrt(std::max(0.0, radius2 - dy * dy) / aspect);
    const double left = std::max(std::ceil(middle - half), 0.0);
    const double right = std::min(std::floor(middle + half), static_cast<double>(image_width - 1));
    if (left > right) continue;

    // Pixels on the boundary are decided by the kernel's strict test, which returns 0 there.
    const int width = static_cast<int>(right - left) + 1;
    spans_.push_back({static_cast<int>(y), static_cast<int>(left), width, used});
    if (weights_.size() < used + static_cast<std::size_t>(width)) weights_.resize(2 * (used + width));
    double* weights = weights_.data() + used;
    for (double x = left; x <= right; x += 1.0) {
      const double dx = x - middle;
      *weights++ = kernel.footprint((aspect * (dx * dx) + dy * dy) * to_units2);
    }
    used += static_cast<std::size_t>(width);
  }
  if (splat.texture != nullptr) modulate(splat);
}

void Footprint::modulate(const ProjectedSplat& splat) {
  const double per_x = 1.0 / std::sqrt(splat.shape.xx);  // kernel units a pixel
  const double per_y = 1.0 / std::sqrt(splat.shape.yy);
  for (const Span& span : spans_) {
    const double v = (span.y - splat.y) * per_y;
    for (int i = 0; i < span.width; ++i) {
      const double u = (span.x + i - splat.x) * per_x;
      weights_[span.weights + i] *= 1.0 + splat.texture_amplitude * (*splat.texture)(u, v);
    }
  }
}

}  // namespace fastsplat::golden
