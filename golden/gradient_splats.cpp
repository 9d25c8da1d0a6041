// SPDX-License-Identifier: Apache-2.0
#include "golden/gradient_splats.hpp"

#include <cassert>
#include <cmath>

namespace fastsplat::golden {

void GradientSplats::add(Sheet& to, int sheet, const Footprint& footprint, const ProjectedSplat& splat,
                         double share) const {
  assert(splat.shape.xx == splat.shape.yy && splat.shape.xy == 0.0 && splat.depth_growth == 1.0);
  const double near_side = geometry_.near_side(sheet) - splat.z;
  const double density = splat.value[3] * share;
  const double along = splat.value[3] * (kernel_.profile(near_side + geometry_.width()) - kernel_.profile(near_side));
  const double across = -2.0 * kernel_.a() * density / std::sqrt(splat.shape.xx);
  for (const Footprint::Span& span : footprint.spans()) {
    const double* weights = footprint.weights(span);
    Sums* sums = to.row(span.y) + span.x;
    const double dy = across * (span.y - splat.y);
    for (int i = 0; i < span.width; ++i) {
      sums[i][0] += weights[i] * (across * (span.x + i - splat.x));
      sums[i][1] += weights[i] * dy;
      sums[i][2] += weights[i] * along;
      sums[i][3] += weights[i] * density;
    }
    to.touch(span.y, {span.x, span.x + span.width});
  }
}

}  // namespace fastsplat::golden
