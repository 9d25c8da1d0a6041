// SPDX-License-Identifier: Apache-2.0
// The output of a correct device for a stream, without a simulator: the model's taps, converted to those of the ports.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/device.hpp"
#include "testbench/device/raw_taps.hpp"

namespace fastsplat::test {

/// A beat that the device takes, or a tap that it outputs.
struct RawEvent {
  std::optional<cmodel::Beat> beat;
  testbench::RawTap tap;  ///< its words are those below
  std::vector<std::uint32_t> words;
};

/// All events in order. A beat's taps follow at once, except for the sums: they come kSumsLater windows later, as in
/// the device. Banks outside the tile hold ones, because no check may look at them.
std::vector<RawEvent> replay(const cmodel::Config& config, std::span<const cmodel::Beat> beats);
constexpr std::size_t kSumsLater = 3;

void play(std::span<const RawEvent> events, testbench::RawTapSink& sink);

}  // namespace fastsplat::test
