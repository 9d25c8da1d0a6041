// What culling brings of a scene: the same frame on devices of every cull.map, with every beat sent and with a source
// that jumps over hidden sets (docs/culling.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cycles/cycle_account.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

struct CullRow {
  std::string map;                      ///< off, block or pixel
  std::optional<std::uint64_t> fetch;   ///< the memory's latency; none: every beat is sent
  std::uint64_t cycles = 0, beats = 0;  ///< busy; sent
  cmodel::CycleAccount account;
  cmodel::Counters counters;  ///< of the cycle model
  cmodel::CullCounts culls;
};

/// off, block, block with fetch, pixel, pixel with fetch.
std::vector<CullRow> compare_culling(const scene::Scene& scene, const cmodel::Config& config, std::uint64_t latency,
                                     int threads = 1, const Progress& progress = {});

/// Of the splat records that the device without culling, the first row, draws, those that this one does.
double share_drawn(const CullRow& row, const CullRow& off);

}  // namespace fastsplat::driver
