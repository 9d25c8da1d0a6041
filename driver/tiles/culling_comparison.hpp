// SPDX-License-Identifier: Apache-2.0
// Measures the gain of culling for a scene: the same frame on devices of every cull.map, with every beat sent and with
// a source that skips hidden sets (docs/culling.md).
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
  std::optional<std::uint64_t> fetch;   ///< the memory's latency; absent: every beat is sent
  std::uint64_t cycles = 0, beats = 0;  ///< busy cycles; beats sent
  cmodel::CycleAccount account;
  cmodel::Counters counters;  ///< counters of the cycle model
  cmodel::CullCounts culls;
};

/// off, block, block with fetch, pixel, pixel with fetch.
std::vector<CullRow> compare_culling(const scene::Scene& scene, const cmodel::Config& config, std::uint64_t latency,
                                     int threads = 1, const Progress& progress = {});

/// Share of drawn splat records, relative to the first row, the device without culling.
double share_drawn(const CullRow& row, const CullRow& off);

}  // namespace fastsplat::driver
