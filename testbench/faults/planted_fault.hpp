// Faults to plant on purpose, to see what a failure looks like: in the RTL of the device that is made to be broken, or
// at the ports of any device, where its checker looks.
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
  const char* meaning;  ///< what is broken, one line
};

/// The configuration whose RTL has the fault; of the ports' faults, any has.
const char* breakable_config(const PlantedFault& fault);

/// Those of the RTL as in faults.def, then those of the ports.
std::span<const PlantedFault> planted_faults();
std::vector<std::string> planted_fault_names();
/// Throws UserError (Usage) with the nearest name.
const PlantedFault& planted_fault_from(const std::string& name);

/// Makes devices that have the fault, for VerifyOptions::device; of the RTL with assertions off, so that the checker
/// is what speaks.
using MakeDevice = std::function<std::unique_ptr<RtlDevice>(cmodel::PixelSink&, const RtlOptions&)>;
MakeDevice with_fault(const PlantedFault& fault, const cmodel::Config& config);

}  // namespace fastsplat::testbench
