// SPDX-License-Identifier: Apache-2.0
// docs/scaling.md written again, clocked: every part is updated in every cycle. It knows the cost of a beat and shares
// nothing with cmodel's cluster, link or queue.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/stall_counters.hpp"
#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::test {

/// The work of a beat in a device.
struct PlainBeat {
  cmodel::Opcode opcode{};
  bool payload = false;      ///< table words
  std::uint64_t cycles = 1;  ///< of a splat or payload beat in decode
  std::uint64_t blocks = 0;  ///< dirty ones; of an end_sheet
  std::uint64_t pixels = 0;  ///< beats of the picture; of an end_tile
  std::uint32_t tile = 0;
};

/// For each beat of a whole stream, from a run on one device.
std::vector<PlainBeat> plain_beats(const cmodel::Config& config, std::span<const cmodel::Beat> beats);

struct PlainDeviceCycles {
  std::vector<std::uint32_t> tiles;
  cmodel::StallCounters stalls;
  std::uint64_t end = 0;
};

/// `rate` bytes a cycle, 0 for no limit.
std::vector<PlainDeviceCycles> plain_cluster(const cmodel::Config& config, std::span<const PlainBeat> beats,
                                             std::size_t devices, std::uint64_t rate, std::size_t queue);

}  // namespace fastsplat::test
