// SPDX-License-Identifier: Apache-2.0
// Parses, calls, maps errors to exit codes (docs/guide/reference.md, "Exit codes").
#include <exception>
#include <new>
#include <string>

#include "base/machine_error.hpp"
#include "cli/command_line.hpp"
#include "cli/output.hpp"
#include "cli/process.hpp"

int main(int argc, char** argv) {
  using namespace fastsplat;
  try {
    cli::prepare_process();
    return static_cast<int>(cli::parse(argc, argv)());
  } catch (const UserError& error) {
    cli::print_error(error.what());
    return static_cast<int>(exit_code_of(error));
  } catch (const std::bad_alloc&) {
    cli::print_error("not enough memory; use a smaller volume or --size");
    return static_cast<int>(machine_exit_code(ExitCode::Input));
  } catch (const std::exception& error) {
    cli::print_error(std::string("internal: ") + error.what() + "; please report it with the command line");
    return static_cast<int>(ExitCode::Internal);
  } catch (...) {
    cli::print_error("internal: unknown exception; please report it with the command line");
    return static_cast<int>(ExitCode::Internal);
  }
}
