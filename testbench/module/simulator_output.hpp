// SPDX-License-Identifier: Apache-2.0
// What the simulator's runtime prints (a failing assertion's line), kept for the device that ran instead of going to
// stdout. The build includes this file in front of the runtime's sources, with VL_PRINTF as simulator_print.
#pragma once

#include <string>

namespace fastsplat::testbench {

/// Replaces printf in the simulator's runtime. Output is kept by thread: one thread runs a device.
int simulator_print(const char* format, ...) __attribute__((format(printf, 1, 2)));
/// Text printed since the last call.
std::string take_simulator_output();

}  // namespace fastsplat::testbench
