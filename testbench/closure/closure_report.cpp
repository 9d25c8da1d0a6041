// SPDX-License-Identifier: Apache-2.0
#include "testbench/closure/closure_report.hpp"

#include <algorithm>
#include <sstream>

#include "base/hash_text.hpp"

namespace fastsplat::testbench {
namespace {

const char* page_word(TestOutcome outcome) {
  switch (outcome) {
    case TestOutcome::NotRun:
      return "not run here";
    case TestOutcome::Passed:
      return "passed";
    case TestOutcome::Failed:
      return "FAILED";
  }
  return "?";
}

void list(std::ostream& out, const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  out << "\n## " << title << "\n\n";
  for (const auto& line : lines) out << "- " << line << "\n";
}

}  // namespace

std::string closure_markdown(const ClosureReport& report) {
  std::ostringstream out;
  out << "# Coverage closure: " << (report.closed() ? "closed" : "OPEN") << "\n\n"
      << "fastsplat " << report.version << "\n\n"
      << "| configuration | hash | streams | splats | cycles | comparisons |\n|---|---|---|---|---|---|\n";
  for (const auto& [book, planned] : report.inputs) {
    out << "| " << book.config << " | " << hash_text(book.config_hash) << " | " << book.streams << " | " << book.splats
        << " | " << book.cycles << " | " << book.comparisons << " |\n";
  }
  list(out, "Campaigns that failed", report.failures);
  list(out, "Open bins and tests", report.closure.findings);
  list(out, "Open lines", report.lines.findings);
  out << "\n## Testpoints: " << report.closure.hit << " of " << report.closure.bins << " bins hit\n\n"
      << "| testpoint | configuration | bins | hit | fewest hits | status |\n|---|---|---|---|---|---|\n";
  for (const ClosureRow& row : report.closure.rows) {
    const auto fewest = std::min_element(row.bins.begin(), row.bins.end(),
                                         [](const ClosureBin& a, const ClosureBin& b) { return a.hits < b.hits; });
    out << "| " << row.testpoint << " | " << row.config << " | " << row.bins.size() << " | " << row.hit << " | "
        << fewest->hits << " (" << fewest->name << ") | " << (row.hit == row.bins.size() ? "closed" : "OPEN") << " |\n";
  }
  out << "\n## Tests\n\n| testpoint | test | runs | |\n|---|---|---|---|\n";
  for (const ClosureTest& test : report.closure.tests)
    out << "| " << test.testpoint << " | " << test.test << " | " << test.runs << " | " << page_word(test.outcome)
        << " |\n";
  if (!report.lines.points.empty()) {
    out << "\n## Lines and branches: " << report.lines.points.size() - report.lines.unreached.size() << " of "
        << report.lines.points.size() << " reached\n\n| place | kind | line | excused because |\n|---|---|---|---|\n";
    for (const LineFinding& finding : report.lines.unreached) {
      out << "| " << finding.point.file << ":" << finding.point.line << " | " << finding.point.kind << " | `"
          << finding.text << "` | " << (finding.reason.empty() ? "**not excused**" : finding.reason) << " |\n";
    }
  }
  return out.str();
}

}  // namespace fastsplat::testbench
