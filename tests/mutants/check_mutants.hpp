// SPDX-License-Identifier: Apache-2.0
// What generated sources give the program check_mutants_<name>.
#pragma once

#include <memory>

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::test {

/// One for each program, with the mutant that is selected.
std::unique_ptr<testbench::RtlDevice> make_mutant(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                  const testbench::RtlOptions& options);

}  // namespace fastsplat::test
