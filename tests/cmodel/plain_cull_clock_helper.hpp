// SPDX-License-Identifier: Apache-2.0
// The stream side of a culling device, clock by clock as in docs/microarchitecture.md: a reference for the cycle model.
// Registers hold beats, a unit builds tables a row at a time, a source waits for verdicts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::test {

/// Cycles in which a beat was taken, was first in decode, and was last in decode.
struct BeatTimes {
  std::uint64_t taken = 0, entered = 0, left = 0;
  bool operator==(const BeatTimes&) const = default;
};

struct PlainCullClock {
  std::vector<BeatTimes> beats;  ///< that were sent, in order
  std::uint64_t waited = 0;      ///< cycles of begin_sheet in t0 for a table
  std::uint64_t starved = 0;     ///< cycles of an open tile, or of a picture in output, in which decode is empty
};

/// Runs a whole stream. `latency`: of a source that omits hidden groups; none: the source sends all.
PlainCullClock plain_cull_clock(const cmodel::Config& config, std::span<const cmodel::Beat> beats,
                                std::optional<std::uint64_t> latency);

}  // namespace fastsplat::test
