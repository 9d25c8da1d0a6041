// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {

std::array<double, 16> harmonics_at(const glm::dvec3& direction) {
  const double x = direction.x, y = direction.y, z = direction.z, xx = x * x, yy = y * y, zz = z * z;
  // sqrt(3/4pi); sqrt(15/4pi), sqrt(5/16pi), sqrt(15/16pi); sqrt(35/32pi), sqrt(105/4pi), sqrt(21/32pi),
  // sqrt(7/16pi), sqrt(105/16pi)
  constexpr double k1 = 0.4886025119029199;
  constexpr double k2 = 1.0925484305920792, k20 = 0.31539156525252005, k22 = 0.5462742152960396;
  constexpr double k33 = 0.5900435899266435, k32 = 2.890611442640554, k31 = 0.4570457994644658,
                   k30 = 0.3731763325901154, k322 = 1.445305721320277;
  return {kConstantHarmonic,
          -k1 * y,
          k1 * z,
          -k1 * x,
          k2 * x * y,
          -k2 * y * z,
          k20 * (2.0 * zz - xx - yy),
          -k2 * x * z,
          k22 * (xx - yy),
          -k33 * y * (3.0 * xx - yy),
          k32 * x * y * z,
          -k31 * y * (4.0 * zz - xx - yy),
          k30 * z * (2.0 * zz - 3.0 * xx - 3.0 * yy),
          -k31 * x * (4.0 * zz - xx - yy),
          k322 * z * (xx - yy),
          -k33 * x * (xx - 3.0 * yy)};
}

glm::dvec3 colour_at(std::span<const glm::vec3> coefficients, const glm::dvec3& direction) {
  const std::array<double, 16> harmonics = harmonics_at(direction);
  glm::dvec3 colour(0.5);
  for (std::size_t i = 0; i < coefficients.size(); ++i) colour += harmonics[i] * glm::dvec3(coefficients[i]);
  return glm::max(colour, glm::dvec3(0.0));
}

}  // namespace fastsplat::scene
