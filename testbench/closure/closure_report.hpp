// The closed (or open) coverage for people: a table in Markdown and one self-contained HTML page.
#pragma once

#include <string>
#include <vector>

#include "testbench/closure/closure.hpp"
#include "testbench/coverage/line_coverage.hpp"

namespace fastsplat::testbench {

struct ClosureReport {
  std::string version;  ///< of the program
  VerificationPlan plan;
  std::vector<ClosureInput> inputs;
  Closure closure;
  LineClosure lines;
  std::vector<std::string> failures;  ///< campaigns that did not pass

  bool closed() const { return failures.empty() && closure.findings.empty() && lines.findings.empty(); }
};

std::string closure_markdown(const ClosureReport& report);
/// Needs nothing but itself: no script, no font, no network.
std::string closure_html(const ClosureReport& report);

}  // namespace fastsplat::testbench
