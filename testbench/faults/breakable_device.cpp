// SPDX-License-Identifier: Apache-2.0
#include "testbench/faults/breakable_device.hpp"

#include "testbench/device/rtl_module.hpp"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {

std::unique_ptr<RtlDevice> make_breakable_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                 const RtlOptions& options, RtlFault fault, Assertions assertions) {
  SimulatorOptions simulator = simulator_options(options);
  simulator.assertions = assertions == Assertions::On;
  simulator.fault = static_cast<std::uint32_t>(fault);
  auto top = open_rtl(config, {.wave = !options.wave.empty(), .faults = true}, simulator);
  return make_verilated_device(std::move(top), config, pixels, options);
}

}  // namespace fastsplat::testbench
