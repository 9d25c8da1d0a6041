// SPDX-License-Identifier: Apache-2.0
// Devices made from Yosys's netlists of rtl/ (tools/cmake/netlist.sh).
#pragma once

#include <memory>

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::test {

std::unique_ptr<testbench::RtlDevice> make_netlist(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                   const testbench::RtlOptions& options);

/// The same with one net tied to 0: a bank does not forward the sum of two windows ago. Null if this program has none.
std::unique_ptr<testbench::RtlDevice> make_cut_netlist(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                       const testbench::RtlOptions& options);

}  // namespace fastsplat::test
