// SPDX-License-Identifier: Apache-2.0
// Build-time tool: prints the SystemVerilog package of a configuration, or its hash as a C++ literal.
#include <cstdio>
#include <cstring>
#include <exception>

#include "base/hash_text.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "driver/config/config_file.hpp"

int main(int argc, char** argv) {
  const bool hash_only = argc == 3 && std::strcmp(argv[1], "--hash") == 0;
  constexpr const char* kUsage =
      "usage: fastsplat_emit_package [--hash] CONFIG\n"
      "The SystemVerilog package of a configuration (a name or a .toml file), to standard output; with --hash its "
      "hash.\n"
      "Exit codes: 0, 2 usage, 3 no such configuration, or no RTL can be built from it.\n";
  if (argc == 2 && std::strcmp(argv[1], "--help") == 0) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  if (argc != 2 && !hash_only) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  try {
    const auto config = fastsplat::driver::load_config(argv[argc - 1]);
    if (const auto violation = fastsplat::cmodel::rtl_violation(config)) fastsplat::throw_input(*violation);
    if (hash_only) {
      std::printf("0x%sULL\n", fastsplat::hash_text(fastsplat::cmodel::config_hash(config)).c_str());
    } else {
      std::fputs(fastsplat::cmodel::sv_package(config).c_str(), stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fastsplat_emit_package: error: %s\n", error.what());
    return 3;
  }
  return 0;
}
