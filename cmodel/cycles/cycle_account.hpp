// SPDX-License-Identifier: Apache-2.0
// Where the cycles of a run go: every busy cycle has exactly one cause (M-account-2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastsplat::cmodel {

// clang-format off
#define FASTSPLAT_CYCLE_KINDS(X)                                                            \
  X(ideal, "windows and dirty blocks: n_1 + sum max(n_s, m_(s-1)) + m_S of every tile")     \
  X(records, "records other than splats, one cycle each")                                   \
  X(table_load, "table words, one cycle each")                                              \
  X(hidden, "hidden splats that were sent and rows of hidden windows, one cycle each")      \
  X(input, "no record: the source was late")                                                \
  X(sheet_buffer, "begin_sheet waits for a buffer, beyond the compositor's ideal")          \
  X(map, "begin_sheet waits for the map of opaque cells")                                   \
  X(drain, "end_tile waits for the pipelines: fill and drain of splat path and compositor") \
  X(hazard, "every sample: a window waits for the previous one, which it overlaps")         \
  X(pixels, "the picture leaves the device")                                                \
  X(output, "a pixel beat waits: the sink was not ready")
// clang-format on

struct CycleAccount {
#define X(name, meaning) std::uint64_t name = 0;
  FASTSPLAT_CYCLE_KINDS(X)
#undef X

  std::uint64_t total() const {
    std::uint64_t sum = 0;
#define X(name, meaning) sum += name;
    FASTSPLAT_CYCLE_KINDS(X)
#undef X
    return sum;
  }
  /// visit(name, cycles, meaning) in the order above; `hazard`, which only modes 4 and 5 have, is left out if it is 0.
  template <class Visit>
  void for_each(Visit visit) const {
#define X(name, meaning) \
  if (&CycleAccount::name != &CycleAccount::hazard || hazard != 0) visit(#name, name, meaning);
    FASTSPLAT_CYCLE_KINDS(X)
#undef X
  }
  CycleAccount& operator+=(const CycleAccount& other) {
#define X(name, meaning) name += other.name;
    FASTSPLAT_CYCLE_KINDS(X)
#undef X
    return *this;
  }
  bool operator==(const CycleAccount&) const = default;
};

/// Why decode issues no window in a cycle. Ideal compositing cycles are taken out of these in this order (M-account-5,
/// M-cull-17).
enum class Pause : std::uint8_t { Buffer, Drain, Map, Input, Hidden, Records, Hazard };
inline constexpr std::size_t kPauses = 7;

/// Finds the causes of cycles, tile after tile. Spans are half-open, [from, to), in rising order.
class Accountant {
 public:
  /// Decode issued no window during the span.
  void pause(Pause kind, std::uint64_t from, std::uint64_t to) {
    if (from >= to) return;
    pauses_[index(kind)] += to - from;
    for (Walk& walk : walks_) walk.add(kind, from, to);
  }
  /// A sheet with `windows` windows was closed; the compositor picks its blocks' slices in [from, to).
  void sheet(std::size_t buffer, std::uint64_t windows, std::uint64_t from, std::uint64_t to);
  /// The walk of this buffer is over, and so is all that it overlapped.
  void settle(std::size_t buffer);
  void table_words(std::uint64_t words) { account_.table_load += words; }
  void pixels(std::uint64_t working, std::uint64_t held) {
    account_.pixels += working;
    account_.output += held;
  }

  /// Requires that every walk was settled.
  CycleAccount account() const;

 private:
  struct Walk {
    std::uint64_t from = 0, to = 0;
    std::uint64_t windows_beside = 0;  ///< windows of the sheet splatted meanwhile
    std::array<std::uint64_t, kPauses> paused{};
    void add(Pause kind, std::uint64_t a, std::uint64_t b);
  };
  static constexpr std::size_t index(Pause kind) { return static_cast<std::size_t>(kind); }

  CycleAccount account_;
  std::array<std::uint64_t, kPauses> pauses_{};
  std::array<Walk, 2> walks_;
};

}  // namespace fastsplat::cmodel
