// SPDX-License-Identifier: Apache-2.0
// The device whose RTL holds every fault of faults.def, one of them chosen when it is made.
#pragma once

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

/// Numbers of the faults, as in the generated fastsplat_fault_pkg.sv; 0 is the healthy device.
enum class RtlFault : std::uint32_t {
  None = 0,
#define FAULT(name, detector, stimulus, assertion, meaning) name,
#include "testbench/faults/faults.def"
#undef FAULT
};

/// Configurations of configs/faults whose RTL can be broken: by every fault but the next ones, by SAMPLE_..., by
/// CULL_..., by POST_...
constexpr const char* kBreakableConfig = "mustfail";
constexpr const char* kBreakableSamples = "westover";
constexpr const char* kBreakableCull = "cull";
constexpr const char* kBreakablePost = "post";

/// Built if needed, as by make_rtl_device(). A fault in a part that `config` lacks shows nowhere. With assertions on,
/// one that fires ends the run. Devices on several threads may have different faults.
std::unique_ptr<RtlDevice> make_breakable_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                 const RtlOptions& options, RtlFault fault, Assertions assertions);

}  // namespace fastsplat::testbench
