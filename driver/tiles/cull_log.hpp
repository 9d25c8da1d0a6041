// SPDX-License-Identifier: Apache-2.0
// The results of a device's cull unit for a scene, an input of the cycle model.
#pragma once

#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cull/terminations.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::driver {

struct CullRun {
  cmodel::CullLog log;  ///< of all tiles
  cmodel::CullCounts counts;
};

/// The same for all tiles and maps, and for all arrays unless these change the number of radius sets: those of a scene
/// in perspective are padded to windows (N-8-27).
cmodel::Terminations terminations(const scene::Scene& scene, const cmodel::Config& config, int threads = 1);

/// Tests the records of all tiles, without the splats of hidden sets, which leaves the tests unchanged; draws no pixel.
/// `threads` (0: all cores) never changes the result. The log is empty for a configuration that does not cull.
CullRun run_culls(const CompiledFrame& compiled, const cmodel::Terminations& terminations, int threads = 1,
                  const Progress& progress = {});

}  // namespace fastsplat::driver
