// SPDX-License-Identifier: Apache-2.0
// Errors of the user, reported in one line: what, where, expected, got, fix.
// Programmer mistakes are not reported this way; they are assertions.
#pragma once

#include <stdexcept>
#include <string>

namespace fastsplat {

/// Exit codes of the command line; they rise with severity (docs/guide/reference.md, "Exit codes").
enum class ExitCode : int {
  Pass = 0,
  Failed = 1,         ///< a verification or threshold failed
  Usage = 2,          ///< invalid command line or parameter
  Input = 3,          ///< invalid file or format, or a result cannot be written
  NotComparable = 4,  ///< the inputs differ in size, channels or format
  Simulation = 5,     ///< timeout, deadlock, assertion in the simulated device
  Internal = 70,
  Interrupted = 130,
};

/// The parts of a one-line message. Empty parts are left out of the line.
struct ErrorParts {
  std::string where;     ///< file, file:line:column, offset, flag
  std::string what;      ///< what is wrong
  std::string expected;  ///< the valid value or range
  std::string got;       ///< the value found
  std::string fix;       ///< what to do, as an imperative
};

/// "where: what (expected E, got G); fix". Control characters from files are escaped, so it stays one line.
std::string one_line(const ErrorParts& parts);

class UserError : public std::runtime_error {
 public:
  UserError(ExitCode code, ErrorParts parts)
      : std::runtime_error(one_line(parts)), code_(code), parts_(std::move(parts)) {}
  ExitCode code() const { return code_; }
  const ErrorParts& parts() const { return parts_; }

 private:
  ExitCode code_;
  ErrorParts parts_;
};

[[noreturn]] inline void throw_input(ErrorParts parts) { throw UserError(ExitCode::Input, std::move(parts)); }
[[noreturn]] inline void throw_usage(ErrorParts parts) { throw UserError(ExitCode::Usage, std::move(parts)); }

}  // namespace fastsplat
