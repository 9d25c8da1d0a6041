// SPDX-License-Identifier: Apache-2.0
// Collects the Gaussians of a file. Drops and counts the ones that cannot be drawn.
#pragma once

#include <string>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// "scale_1 is not finite", in the names of a PLY's properties; empty for a Gaussian that can be drawn.
std::string fault_of(const Gaussian& gaussian, std::span<const glm::vec3> harmonics);

class GaussianRows {
 public:
  /// Fills `to`, which outlives it; `where` names the file.
  GaussianRows(GaussianCloud& to, std::string where) : to_(to), where_(std::move(where)) {}

  /// The next Gaussian: its rotation of any length as w x y z, and harmonic_count(degree) harmonics.
  void add(Gaussian gaussian, const glm::dvec4& rotation, std::span<const glm::vec3> harmonics);
  /// The next Gaussian is dropped for this reason.
  void drop(const std::string& fault);
  /// Adds dropped Gaussians to the cloud, with a remark. UserError (Input) if no Gaussian is left.
  void end();

 private:
  GaussianCloud& to_;
  std::string where_;
  std::size_t rows_ = 0;
  std::vector<DroppedGaussians> dropped_;
};

}  // namespace fastsplat::scene
