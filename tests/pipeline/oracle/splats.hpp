// SPDX-License-Identifier: Apache-2.0
// The first seven steps written again, for the oracle of the mixtures: from a voxel's splat to its part in each sheet.
#pragma once

#include <array>
#include <vector>

#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"
#include "tests/pipeline/oracle/rounding.hpp"

namespace fastsplat::stages::oracle {

using Values = std::array<double, 4>;  ///< R, G, B and optical depth

struct Splat {
  double x = 0.0, y = 0.0, radius = 0.0;  ///< pixels
  std::vector<Values> shares;             ///< of every sheet of the frame
  int first = 0;                          ///< the nearest sheet that its kernel reaches, if depth is not the device's
  glm::vec3 position{0.0F};               ///< of its voxel
  Closeness closeness;
};

/// In the order in which sheets add them: by first sheet, then in traversal order, densities in memory order. Sums of
/// words do not depend on it.
std::vector<Splat> splats_of(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture);

}  // namespace fastsplat::stages::oracle
