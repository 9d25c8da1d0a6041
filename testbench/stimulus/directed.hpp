// SPDX-License-Identifier: Apache-2.0
// Directed checks beyond legal streams: the registers, streams that the device has to refuse, the shortest resets
// (docs/microarchitecture.md, "Registers"). Each samples its own bins.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "testbench/coverage/coverage.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

using MakeDevice = std::function<std::unique_ptr<RtlDevice>(cmodel::PixelSink&, const RtlOptions&)>;

struct DirectedResult {
  std::uint64_t comparisons = 0;
  std::vector<std::string> failures;   ///< what, expected, got
  Coverage coverage;                   ///< register.*, refusal.* or short_reset.*
  std::map<std::string, int> refused;  ///< streams that were refused as the model refuses them, by rule
};

/// All bins of the three.
Coverage directed_bins();
/// Those of check_refusals().
Coverage refusal_bins();

/// `streams` small streams with random damage: refused as the model refuses them, or taken and equal to it.
DirectedResult check_damage(const cmodel::Config& config, const MakeDevice& make, std::uint64_t seed, int streams);

/// Identity, status, counters (against the model, cleared by CONTROL), answers to unknown addresses, answers that wait,
/// halves of writes, resets that drop answers.
DirectedResult check_registers(const cmodel::Config& config, const MakeDevice& make);

/// Breaks each rule that a device checks, in every way the small stream allows. The device must refuse the model's beat
/// by the model's rule, in ERROR and ERROR_BEAT. An open tile comes out as if it had ended there, marked, with every
/// tap and cycle of the model; the rest is dropped. After a soft or hard reset a good frame comes out right. Also soft
/// resets within a tile, accesses in the middle of a frame (mid_frame.hpp), and state between frames
/// (frame_after_frame.hpp).
DirectedResult check_refusals(const cmodel::Config& config, const MakeDevice& make);

/// A reset of one cycle with each record of a stream but begin_frame in the device's register, then the whole stream
/// under the checker.
DirectedResult check_short_resets(const cmodel::Config& config, const MakeDevice& make);

}  // namespace fastsplat::testbench
