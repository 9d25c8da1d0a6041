// SPDX-License-Identifier: Apache-2.0
// Faults planted on purpose, to show the form of a failure: in the RTL of a breakable device, or at the ports of any
// device, in front of its checker.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "testbench/device/rtl_device.hpp"
#include "testbench/faults/breakable_device.hpp"

namespace fastsplat::testbench {

struct PlantedFault {
  enum class Where {
    Rtl,    ///< needs the configuration breakable_config()
    Ports,  ///< any configuration; signals and waveforms are healthy
  };
  const char* name;
  Where where;
  const char* meaning;  ///< the fault, one line
};

/// The configuration whose RTL has the fault; faults at the ports exist in any.
const char* breakable_config(const PlantedFault& fault);

/// The RTL's, as in faults.def, then the ports'.
std::span<const PlantedFault> planted_faults();
std::vector<std::string> planted_fault_names();
/// Throws UserError (Usage) for unknown names, with the nearest one.
const PlantedFault& planted_fault_from(const std::string& name);

/// Makes devices with the fault, for VerifyOptions::device. Faults of the RTL run with assertions off, so that the
/// checker reports them.
using MakeDevice = std::function<std::unique_ptr<RtlDevice>(cmodel::PixelSink&, const RtlOptions&)>;
MakeDevice with_fault(const PlantedFault& fault, const cmodel::Config& config);

}  // namespace fastsplat::testbench
