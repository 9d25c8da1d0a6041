// Directed checks of what no legal stream reaches: the registers, streams that the device has to refuse, the
// shortest resets
// (docs/microarchitecture.md, "Registers"). Each samples its own bins.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "testbench/coverage/coverage.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

using MakeDevice = std::function<std::unique_ptr<RtlDevice>(cmodel::PixelSink&, const RtlOptions&)>;

struct DirectedResult {
  std::uint64_t comparisons = 0;
  std::vector<std::string> failures;  ///< what, expected, got
  Coverage coverage;                  ///< register.*, refusal.* or short_reset.*
};

/// Every bin of the three.
Coverage directed_bins();

/// Identity, status, counters (against the model, cleared by CONTROL), answers to unknown addresses, answers that wait,
/// halves of writes, resets that drop answers.
DirectedResult check_registers(const cmodel::Config& config, const MakeDevice& make);

/// begin_frame with a wrong magic, version or hash and records of unknown opcode: refused at once, opcode in STATUS,
/// the rest swallowed; after a reset the device works again.
DirectedResult check_refusals(const cmodel::Config& config, const MakeDevice& make);

/// A reset of one cycle with each record of a stream but begin_frame in the device's register, then the whole stream
/// under the checker.
DirectedResult check_short_resets(const cmodel::Config& config, const MakeDevice& make);

}  // namespace fastsplat::testbench
