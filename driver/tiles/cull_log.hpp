// What a device's cull unit finds in a scene: for the cycle model, whose time depends on it.
#pragma once

#include "cmodel/cull/cull_log.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::driver {

struct CullRun {
  cmodel::CullLog log;  ///< of all tiles
  cmodel::CullCounts counts;
  cmodel::Counters counters;
};

/// All tiles through the plain model, without the splats of hidden sets: their tests, and those alone, are the same.
/// `threads` (0: all cores) never changes the result. Nothing is logged of a configuration that does not cull.
CullRun run_culls(const CompiledFrame& compiled, int threads = 1, const Progress& progress = {});

}  // namespace fastsplat::driver
