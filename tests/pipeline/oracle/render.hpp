// SPDX-License-Identifier: Apache-2.0
// A second path to the pictures of docs/errors.md, section 1, written from that page: every splat, sheet and pixel.
#pragma once

#include <array>
#include <vector>

#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"

namespace fastsplat::stages::oracle {

/// R, G, B, A of each pixel, row by row. `close` also returns the pixels that depend on a decision within the last bits
/// of a double (rounding.hpp).
std::vector<std::array<double, 4>> render(const scene::Scene& scene, const cmodel::Config& config,
                                          const Mixture& mixture, std::vector<bool>* close = nullptr);

}  // namespace fastsplat::stages::oracle
