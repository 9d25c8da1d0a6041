// What generated sources give the program check_mutants_<name>, and the mutant that its devices have.
#pragma once

#include <memory>

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::test {

/// Of every device made from now on; 0: none.
inline int selected_mutant = 0;

/// Generated, one for each program.
std::unique_ptr<testbench::RtlDevice> make_mutant(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                  const testbench::RtlOptions& options);

}  // namespace fastsplat::test
