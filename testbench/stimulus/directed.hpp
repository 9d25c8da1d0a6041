// Directed checks of what no legal stream reaches: the registers, and streams that the device has to refuse
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
  Coverage coverage;                  ///< register.* or refusal.*
};

/// Every bin of the two.
Coverage directed_bins();

/// Identity, status, counters (against the model, cleared by CONTROL), answers to unknown addresses, answers that wait.
DirectedResult check_registers(const cmodel::Config& config, const MakeDevice& make);

/// begin_frame with a wrong magic, version or hash and records of unknown opcode: refused at once, opcode in STATUS,
/// the rest swallowed; after a reset the device works again.
DirectedResult check_refusals(const cmodel::Config& config, const MakeDevice& make);

}  // namespace fastsplat::testbench
