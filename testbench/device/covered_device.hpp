// SPDX-License-Identifier: Apache-2.0
// A device that delivers its line counts when it is destroyed.
#pragma once

#include "testbench/device/covered_registry.hpp"
#include "testbench/module/simulated_top.hpp"

namespace fastsplat::testbench {

std::unique_ptr<RtlDevice> make_covered_device(std::unique_ptr<SimulatedTop> top, const cmodel::Config& config,
                                               cmodel::PixelSink& pixels, const RtlOptions& options,
                                               const CoverageDat& dat);

}  // namespace fastsplat::testbench
