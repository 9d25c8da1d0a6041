// SPDX-License-Identifier: Apache-2.0
// Statistics of the values at every narrowing site of the device in a whole frame.
#pragma once

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/observers.hpp"
#include "driver/tiles/render.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

struct FrameRanges {
  cmodel::Ranges ranges;
  cmodel::Counters counters;
  DriverReport report;
};

/// Uses the plain unit, tile after tile, and ignores options.unit: only the plain unit can be observed. Throws as
/// render() does.
FrameRanges frame_ranges(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options = {});

}  // namespace fastsplat::driver
