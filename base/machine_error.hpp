// SPDX-License-Identifier: Apache-2.0
// Failures of the machine, not errors of the user: disk, memory, processes, vanished files. The same command may
// succeed later, so a sweep does not record them as results.
#pragma once

#include <utility>

#include "base/error.hpp"

namespace fastsplat {

class MachineError : public UserError {
 public:
  explicit MachineError(ErrorParts parts, ExitCode code = ExitCode::Input) : UserError(code, std::move(parts)) {}
};

[[noreturn]] inline void throw_machine(ErrorParts parts) { throw MachineError(std::move(parts)); }

/// Throws `parts` and `code` as an error of the kind of `error`: a MachineError if it is one.
[[noreturn]] void throw_again(const UserError& error, ErrorParts parts, ExitCode code);

/// The exit code of every MachineError in a process whose environment has kReportMachine.
inline constexpr int kMachineExit = 75;
inline constexpr const char* kReportMachine = "FASTSPLAT_REPORT_MACHINE";

/// The exit code of a process that ends with `error`.
ExitCode exit_code_of(const UserError& error);
/// The exit code of a process that ends with a failure of the machine; `code` is its code in other processes.
ExitCode machine_exit_code(ExitCode code);

}  // namespace fastsplat
