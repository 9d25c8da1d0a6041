// SPDX-License-Identifier: Apache-2.0
// Output formats of coverage closure: tables in Markdown, and JSON that `fastsplat report` draws.
#pragma once

#include <string>
#include <vector>

#include "testbench/closure/closure.hpp"
#include "testbench/coverage/line_coverage.hpp"

namespace fastsplat::testbench {

struct ClosureReport {
  std::string version;  ///< of the program
  std::string command;  ///< that reproduces it
  VerificationPlan plan;
  std::vector<ClosureInput> inputs;
  Closure closure;
  LineClosure lines;
  std::vector<std::string> failures;  ///< campaigns that did not pass

  bool closed() const { return failures.empty() && closure.findings.empty() && lines.findings.empty(); }
};

std::string closure_markdown(const ClosureReport& report);
/// In the format of the subcommands' --json, with the subcommand "closure"; docs/verify.md has the keys.
std::string closure_json(const ClosureReport& report);

}  // namespace fastsplat::testbench
