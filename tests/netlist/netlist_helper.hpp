// SPDX-License-Identifier: Apache-2.0
// Devices that are not rtl/ itself but what Yosys made of it (tools/cmake/netlist.sh).
#pragma once

#include <memory>

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::test {

std::unique_ptr<testbench::RtlDevice> make_netlist(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                   const testbench::RtlOptions& options);

/// The same with one net tied to 0: a bank forwards no sum of two windows ago. Null where this program has none.
std::unique_ptr<testbench::RtlDevice> make_cut_netlist(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                       const testbench::RtlOptions& options);

}  // namespace fastsplat::test
