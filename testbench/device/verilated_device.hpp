// SPDX-License-Identifier: Apache-2.0
// Drives a simulated top as an RtlDevice: beats, pixels and register accesses become clock cycles, its ports become
// taps.
#pragma once

#include <memory>

#include "testbench/device/rtl_device.hpp"
#include "testbench/module/simulated_top.hpp"

namespace fastsplat::testbench {

SimulatorOptions simulator_options(const RtlOptions& options);

/// Throws UserError (Simulation) when the configuration hash in the top's registers is not `config`'s, UserError
/// (Input) when a waveform that `options` name cannot be written.
std::unique_ptr<RtlDevice> make_verilated_device(std::unique_ptr<SimulatedTop> top, const cmodel::Config& config,
                                                 cmodel::PixelSink& pixels, const RtlOptions& options);

}  // namespace fastsplat::testbench
