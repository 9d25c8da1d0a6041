// Build-time tool: the SystemVerilog package of a configuration, to standard output.
#include <cstdio>
#include <exception>

#include "cmodel/sv_package.hpp"
#include "driver/config_file.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fastsplat_emit_package CONFIG\n");
    return 2;
  }
  try {
    const auto config = fastsplat::driver::load_config(argv[1]);
    if (const auto violation = fastsplat::cmodel::rtl_violation(config)) fastsplat::throw_input(*violation);
    std::fputs(fastsplat::cmodel::sv_package(config).c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
