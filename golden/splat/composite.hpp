// SPDX-License-Identifier: Apache-2.0
// Converts sums (of a sheet, a splat, or a step along a ray) to colour and opacity, and composites front to back.
#pragma once

#include <algorithm>
#include <cmath>

#include "golden/splat/projected_splat.hpp"
#include "scene/scene.hpp"

namespace fastsplat::golden {

/// Premultiplied colour and opacity of one layer.
struct Layer {
  double red = 0.0, green = 0.0, blue = 0.0, alpha = 0.0;
};

/// Exponential: the layer's material is mixed evenly over its depth and dims itself,
///     alpha = 1 - exp(-tau),   colour = C (1 - exp(-tau)) / tau,
/// the exact integral for constant emission and extinction. Its error is of second order in the layer's depth.
/// Additive: alpha = min(1, tau), colour = min(1, C), as in the papers; first order.
inline Layer make_layer(const Sums& sums, scene::SlabOpacity opacity) {
  const double tau = sums[3];
  if (opacity == scene::SlabOpacity::Additive) {
    return {std::min(1.0, sums[0]), std::min(1.0, sums[1]), std::min(1.0, sums[2]), std::min(1.0, tau)};
  }
  if (!(tau > 0.0)) return {sums[0], sums[1], sums[2], 0.0};
  const double alpha = -std::expm1(-tau);
  const double dimming = alpha / tau;
  return {sums[0] * dimming, sums[1] * dimming, sums[2] * dimming, alpha};
}

/// A pixel composited front to back: its colour so far, and the transmittance to splats behind.
struct FrontToBack {
  double red = 0.0, green = 0.0, blue = 0.0, transmittance = 1.0;

  void add(const Layer& layer) {
    red += transmittance * layer.red;
    green += transmittance * layer.green;
    blue += transmittance * layer.blue;
    transmittance *= 1.0 - layer.alpha;
  }

  void store(float* rgba) const {
    rgba[0] = static_cast<float>(red);
    rgba[1] = static_cast<float>(green);
    rgba[2] = static_cast<float>(blue);
    rgba[3] = static_cast<float>(1.0 - transmittance);
  }
};

}  // namespace fastsplat::golden
