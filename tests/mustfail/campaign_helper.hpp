// SPDX-License-Identifier: Apache-2.0
// Runs the device with one fault through verify() and returns the first detector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "testbench/check/checker.hpp"
#include "testbench/device/rtl_device.hpp"
#include "testbench/faults/breakable_device.hpp"

namespace fastsplat::test {

using Fault = testbench::RtlFault;
using testbench::Assertions;

/// The detectors of testbench::Detector, in its order, then the ways in which a simulation may end.
enum class Detector {
  Snap,
  Footprint,
  Sheet,
  Composite,
  Pixel,
  Tiles,
  Counters,
  Cycles,
  Verdicts,
  Timeout,
  Assertion,
  Other
};
const char* to_string(Detector detector);

enum class Stimulus {
  Random,       ///< random streams, bubbles on the input, back-pressure on the output
  HotSpot,      ///< sheet after sheet on a few words, without a stall and with bubbles
  Bright,       ///< the same with colours and weights that saturate the sheet
  HotSamples,   ///< every sample composited: tile after tile on a few pixels, at every distance
  EarlyFreeze,  ///< sheets of few splats freeze pixels at once, so that tables wait for each other; tiles of one
                ///< block's width, too
  WarmReset,    ///< a reset in the middle of a sheet, then the stream from its beginning; memories power up as zero
};
constexpr Stimulus kStimuli[] = {Stimulus::Random,     Stimulus::HotSpot,     Stimulus::Bright,
                                 Stimulus::HotSamples, Stimulus::EarlyFreeze, Stimulus::WarmReset};
const char* to_string(Stimulus stimulus);

/// The detector, and its message.
struct Caught {
  Detector by = Detector::Other;
  std::string report;
};
struct Outcome {
  std::optional<Caught> caught;
  std::uint64_t comparisons = 0;
};

using MakeDevice = std::function<std::unique_ptr<testbench::RtlDevice>(const cmodel::Config&, cmodel::PixelSink&,
                                                                       const testbench::RtlOptions&)>;
/// Until the first detector reports or the stimulus ends.
Outcome run(const cmodel::Config& config, Stimulus stimulus, const MakeDevice& make);

/// The device with faults. With assertions on, a failing one ends the run with Detector::Assertion.
inline MakeDevice faulty(Fault fault, Assertions assertions) {
  return [=](const cmodel::Config& config, cmodel::PixelSink& pixels, const testbench::RtlOptions& options) {
    return testbench::make_breakable_device(config, pixels, options, fault, assertions);
  };
}

}  // namespace fastsplat::test
