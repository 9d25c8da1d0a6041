// SPDX-License-Identifier: Apache-2.0
// build_rtl_module FOLDER CONFIG [wave] [faults]: builds a configuration's module of RTL into FOLDER, unless it exists.
#include <cstdio>
#include <string>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/device/rtl_module.hpp"

int main(int argc, char** argv) {
  using namespace fastsplat;
  testbench::RtlAbilities abilities;
  for (int i = 3; i < argc; ++i) (argv[i] == std::string("wave") ? abilities.wave : abilities.faults) = true;
  try {
    testbench::watch_rtl_builds({.begin = [](const std::string&) { return Progress{}; }, .end = [] {}});
    testbench::rtl_module_in(argv[1], driver::load_config(argv[2]), abilities);
    return 0;
  } catch (const UserError& error) {
    std::fprintf(stderr, "build_rtl_module: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
