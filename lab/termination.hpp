// SPDX-License-Identifier: Apache-2.0
// Which pixels the device terminates early, and in which sheet.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"

namespace fastsplat::lab {

/// Row by row. X-rays never terminate a pixel, and neither does composite.freeze_below = 0.
struct TerminationMap {
  int width = 0, height = 0;
  std::vector<std::int32_t> sheets;  ///< sheet in which the transmittance fell below composite.freeze_below; -1: never
};

/// Draws the frame with the plain model. Throws UserError (Usage) as driver::render does.
TerminationMap termination(const scene::Scene& scene, const cmodel::Config& config);

}  // namespace fastsplat::lab
