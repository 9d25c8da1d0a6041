// SPDX-License-Identifier: Apache-2.0
// The results of a device's cull unit for a scene, an input of the cycle model.
#pragma once

#include "cmodel/cull/cull_log.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::driver {

struct CullRun {
  cmodel::CullLog log;  ///< of all tiles
  cmodel::CullCounts counts;
  cmodel::Counters counters;
};

/// Runs all tiles through the plain model, without the splats of hidden sets, which leaves the tests unchanged.
/// `threads` (0: all cores) never changes the result. The log is empty for a configuration that does not cull.
CullRun run_culls(const CompiledFrame& compiled, int threads = 1, const Progress& progress = {});

}  // namespace fastsplat::driver
