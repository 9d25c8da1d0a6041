// SPDX-License-Identifier: Apache-2.0
// Faults between a device's ports and their observers.
#pragma once

#include <memory>

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

/// PORT_FAULT(NAME, description). Each is a function of the stream, not of time: a smaller stream shows it as well.
#define FASTSPLAT_PORT_FAULTS(PORT_FAULT)                                                                    \
  PORT_FAULT(PORT_SNAP, "tap snap: one phase more in x for every seventh splat of a tile")                   \
  PORT_FAULT(PORT_FOOTPRINT, "tap footprint: last bit of the first weight of every seventh splat of a tile") \
  PORT_FAULT(PORT_SHEET, "tap sheet: last bit of the first sum of every seventh splat of a tile")            \
  PORT_FAULT(PORT_COMPOSITE, "tap composite: last bit of the first word of each tile's second block")        \
  PORT_FAULT(PORT_PIXEL, "pixels: last bit of the first word of each tile's last beat")                      \
  PORT_FAULT(PORT_LOST, "tap composite: each tile's second block is never reported")                         \
  PORT_FAULT(PORT_TWICE, "tap snap: every seventh splat of a tile is reported twice")                        \
  PORT_FAULT(PORT_COUNTER, "counters: one splat too many")                                                   \
  PORT_FAULT(PORT_CYCLE, "counters: one busy cycle too many")

enum class PortFault {
#define PORT_FAULT(name, meaning) name,
  FASTSPLAT_PORT_FAULTS(PORT_FAULT)
#undef PORT_FAULT
};

using MakeHealthy = std::unique_ptr<RtlDevice> (*)(const cmodel::Config&, cmodel::PixelSink&, const RtlOptions&);
/// A device of `make` with the fault at its ports.
std::unique_ptr<RtlDevice> with_port_fault(PortFault fault, MakeHealthy make, const cmodel::Config& config,
                                           cmodel::PixelSink& pixels, const RtlOptions& options);

}  // namespace fastsplat::testbench
