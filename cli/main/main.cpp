// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.hpp"
#include "cli/process.hpp"

int main(int argc, char** argv) {
  fastsplat::cli::prepare_process();
  return fastsplat::cli::run_program(argc, argv);
}
