// SPDX-License-Identifier: Apache-2.0
#include "cmodel/splat/ellipse_unit.hpp"

namespace fastsplat::cmodel {

EllipseCoefficients EllipseUnit::coefficients(const EllipseShape& shape, std::int64_t dx, std::int64_t dy) const {
  const std::int64_t a = shape.a, b = shape.b, c = shape.c, pixel = std::int64_t{1} << config_.position_frac_bits;
  const Narrowing narrow(Rounding::RND, Overflow::WRAP, static_cast<int>(shape.shift), format_);
  return {.u0 = narrow(exact_q(shape, dx, dy)).word,
          .u1 = narrow(pixel * (2 * a * dx + b * dy)).word,
          .u2 = narrow(pixel * pixel * a).word,
          .v1 = narrow(pixel * (2 * c * dy + b * dx)).word,
          .v2 = narrow(pixel * pixel * c).word,
          .e = narrow(pixel * pixel * b).word};
}

}  // namespace fastsplat::cmodel
