// SPDX-License-Identifier: Apache-2.0
// The tables of a device with solid patterns: a texture's pattern and a bump map's lean (scaled gradient) at the nodes
// over the visible range (docs/numerics.md, sections 6.3 and 8).
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// Whether a frame has a texture at pixels, or bumps.
bool has_pattern(const scene::SceneDescription& description);

/// NODES and PATTERN, in this order, for a scene that has_pattern(). They do not depend on the number of threads.
std::vector<cmodel::LoadTable> pattern_tables(const cmodel::Config& config, const scene::Scene& scene,
                                              const scene::SlabGrid& slabs, int threads);

}  // namespace fastsplat::driver
