// The cycle counters of the device (registers after those of FASTSPLAT_COUNTERS): how long it worked, and for what it
// waited.
#pragma once

#include <cstdint>

namespace fastsplat::cmodel {

// clang-format off
/// X(name, register, what it counts)
#define FASTSPLAT_STALL_COUNTERS(X)                                     \
  X(busy, CYCLES, "cycles")                                             \
  X(stall_input, STALL_INPUT, "cycles without input")                   \
  X(stall_table, STALL_TABLE, "cycles of table words")                  \
  X(stall_buffer, STALL_BUFFER, "cycles of waiting for a sheet buffer") \
  X(stall_tile, STALL_TILE, "cycles of waiting between tiles")
// clang-format on

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

  /// visit(name, value, meaning) in the order above.
  template <class Visit>
  void for_each(Visit visit) const {
#define X(name, counter, meaning) visit(#name, name, meaning);
    FASTSPLAT_STALL_COUNTERS(X)
#undef X
  }
};

}  // namespace fastsplat::cmodel
