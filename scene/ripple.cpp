// SPDX-License-Identifier: Apache-2.0
#include "scene/ripple.hpp"

#include <cmath>
#include <numbers>

namespace fastsplat::scene {

double ripple_bound(const Kernel& kernel, double tilt) {
  const double shear = std::sqrt(1.0 + 0.25 * tilt * tilt) - 0.5 * tilt;
  double theta = 1.0;
  for (int n = 1; n < 64; ++n) {
    const double frequency = std::numbers::pi * n * shear;
    theta += 2.0 * std::exp(-frequency * frequency / kernel.a());
  }
  const double r2 = kernel.radius() * kernel.radius();
  const double inside = -std::expm1(-kernel.a() * r2) * std::erf(std::sqrt(kernel.a()) * kernel.radius());
  return theta * theta * theta / inside - 1.0;
}

}  // namespace fastsplat::scene
