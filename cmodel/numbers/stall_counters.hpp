// SPDX-License-Identifier: Apache-2.0
// The counters whose registers follow those of FASTSPLAT_COUNTERS: busy cycles, waits, and culled work (M-register-16,
// M-register-17).
#pragma once

#include <cstdint>
#include <string_view>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

// clang-format off
/// X(name, register, what it counts). Not every device has those from STALL_HAZARD on: see has_counter().
#define FASTSPLAT_STALL_COUNTERS(X)                                     \
  X(busy, CYCLES, "cycles")                                             \
  X(stall_input, STALL_INPUT, "cycles without input")                   \
  X(stall_table, STALL_TABLE, "cycles of table words")                  \
  X(stall_buffer, STALL_BUFFER, "cycles waiting for a sheet buffer") \
  X(stall_tile, STALL_TILE, "cycles waiting between tiles")          \
  X(stall_hazard, STALL_HAZARD, "cycles in which a window waits for the previous one (composite.every_sample = 1; 0 if only cull.map is on)") \
  X(cull_tests, CULL_TESTS, "cull groups and splats tested (cull.map not off)") \
  X(hidden_sets, HIDDEN_SETS, "hidden cull groups (cull.map not off)")         \
  X(hidden_splats, HIDDEN_SPLATS, "hidden splats that were sent and belong to no hidden cull group (cull.map not off)") \
  X(hidden_windows, HIDDEN_WINDOWS, "hidden windows of visible splats (cull.map not off)")
// clang-format on

/// Whether a device of this configuration has the counter of that register name. Counter numbers have no gaps: a device
/// that culls also has STALL_HAZARD, which stays 0 without composite.every_sample.
inline bool has_counter(const Config& config, std::string_view counter) {
  if (counter == "STALL_HAZARD") return config.composite_every_sample != 0 || config.culls();
  const bool of_culling = counter == "CULL_TESTS" || counter.starts_with("HIDDEN_");
  return config.culls() || !of_culling;
}

struct StallCounters {
#define X(name, counter, meaning) std::uint64_t name = 0;
  FASTSPLAT_STALL_COUNTERS(X)
#undef X

  StallCounters& operator+=(const StallCounters& other) {
#define X(name, counter, meaning) name += other.name;
    FASTSPLAT_STALL_COUNTERS(X)
#undef X
    return *this;
  }
  bool operator==(const StallCounters&) const = default;

  /// visit(name, value, meaning) in the order above, for the counters that the configuration has.
  template <class Visit>
  void for_each(const Config& config, Visit visit) const {
#define X(name, counter, meaning) \
  if (has_counter(config, #counter)) visit(#name, name, meaning);
    FASTSPLAT_STALL_COUNTERS(X)
#undef X
  }
};

}  // namespace fastsplat::cmodel
