// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/ellipse_distance.hpp"

#include <algorithm>
#include <cmath>

namespace fastsplat::stages {

void EllipseDistance::begin(const StagedSplat& splat, const StagedShape& shape, const Mixture& mixture,
                            const cmodel::EllipseWindows& windows) {
  const cmodel::EllipseAxis x = cmodel::ellipse_axis(config_, shape.word_x, windows.left),
                            y = cmodel::ellipse_axis(config_, shape.word_y, windows.top);
  left_ = x.origin;
  top_ = y.origin;
  if (mixture.device(Step::Radius) && mixture.device(Step::Position)) {
    words_ = unit_.coefficients(shape.words, x.distance, y.distance);
    return;
  }
  const auto rounded = [this](double entries) {
    return static_cast<std::int64_t>(std::floor(std::ldexp(entries, step_) + 0.5));
  };
  const double dx = left_ - splat.x, dy = top_ - splat.y;
  words_ = {.u0 = rounded(shape.a * dx * dx + shape.b * dx * dy + shape.c * dy * dy),
            .u1 = rounded(2.0 * shape.a * dx + shape.b * dy),
            .u2 = rounded(shape.a),
            .v1 = rounded(2.0 * shape.c * dy + shape.b * dx),
            .v2 = rounded(shape.c),
            .e = rounded(shape.b)};
}

double EllipseDistance::at(int i, int j) const {
  return std::ldexp(static_cast<double>(std::max<std::int64_t>(unit_.q(words_, i, j), 0)), -step_);
}

}  // namespace fastsplat::stages
