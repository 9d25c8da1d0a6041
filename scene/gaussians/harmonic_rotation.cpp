// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/harmonic_rotation.hpp"

#include <cmath>
#include <numbers>

#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {

HarmonicRotation::HarmonicRotation(const glm::dmat3& turn) {
  // Integrals over the sphere of Y_i(d) Y_j(R^-1 d), polynomials of degree 6 at most: exact with Gauss and Legendre's
  // four heights and eight longitudes.
  constexpr std::array<double, 2> kHeights{0.33998104358485626, 0.86113631159405258};
  constexpr std::array<double, 2> kWeights{0.65214515486254614, 0.34785484513745386};
  constexpr int kLongitudes = 8;
  const glm::dmat3 back = glm::transpose(turn);
  for (std::size_t k = 0; k < 4; ++k) {
    const double z = k % 2 == 0 ? kHeights[k / 2] : -kHeights[k / 2], ring = std::sqrt(1.0 - z * z);
    for (int step = 0; step < kLongitudes; ++step) {
      const double angle = 2.0 * std::numbers::pi * step / kLongitudes;
      const glm::dvec3 direction(ring * std::cos(angle), ring * std::sin(angle), z);
      const auto there = harmonics_at(direction), before = harmonics_at(back * direction);
      const double weight = kWeights[k / 2] * 2.0 * std::numbers::pi / kLongitudes;
      for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = 0; j < 16; ++j) matrix_[i][j] += weight * there[i] * before[j];
    }
  }
}

void HarmonicRotation::apply(std::span<glm::vec3> coefficients) const {
  std::array<glm::dvec3, 16> turned{};
  for (std::size_t first = 1, width = 3; first < coefficients.size(); first += width, width += 2) {
    for (std::size_t i = first; i < first + width; ++i)
      for (std::size_t j = first; j < first + width; ++j) turned[i] += matrix_[i][j] * glm::dvec3(coefficients[j]);
  }
  for (std::size_t i = 1; i < coefficients.size(); ++i) coefficients[i] = turned[i];
}

}  // namespace fastsplat::scene
