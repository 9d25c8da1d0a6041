// SPDX-License-Identifier: Apache-2.0
#include "base/machine_error.hpp"

#include <cstdlib>

namespace fastsplat {

namespace {

bool is_of_machine(const UserError& error) { return dynamic_cast<const MachineError*>(&error) != nullptr; }

}  // namespace

void throw_again(const UserError& error, ErrorParts parts, ExitCode code) {
  if (is_of_machine(error)) throw MachineError(std::move(parts), code);
  throw UserError(code, std::move(parts));
}

ExitCode machine_exit_code(ExitCode code) {
  return std::getenv(kReportMachine) == nullptr ? code : static_cast<ExitCode>(kMachineExit);
}

ExitCode exit_code_of(const UserError& error) {
  return is_of_machine(error) ? machine_exit_code(error.code()) : error.code();
}

}  // namespace fastsplat
