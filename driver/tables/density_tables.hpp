// SPDX-License-Identifier: Apache-2.0
// The tables of a device that classifies densities: transfer function, 1/sqrt, Phong, light and scales as words
// (docs/numerics.md, sections 6.2 and 8).
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// Whether a frame's sheets hold densities (modes 8 and 9).
bool holds_densities(const scene::SceneDescription& description);

/// Throws UserError (Usage) if the transfer function shows the volume's least value: the device cannot detect where the
/// volume ends.
void check_densities(const scene::Scene& scene);

/// The gradient below which nothing is shaded, as a part of the volume's range in a kernel unit; 0: none.
double gradient_floor(const scene::Scene& scene);

/// CLASSIFY, ROOT, GLINT, LIGHTING and SHEETS, in this order.
std::vector<cmodel::LoadTable> density_tables(const cmodel::Config& config, const scene::Scene& scene,
                                              const scene::SlabGrid& slabs);

}  // namespace fastsplat::driver
