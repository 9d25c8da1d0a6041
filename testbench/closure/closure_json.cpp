// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "base/json_text.hpp"
#include "testbench/closure/closure_report.hpp"

namespace fastsplat::testbench {
namespace {

using Json = nlohmann::ordered_json;

const char* json_word(TestOutcome outcome) {
  switch (outcome) {
    case TestOutcome::Passed:
      return "passed";
    case TestOutcome::Failed:
      return "failed";
    case TestOutcome::NotRun:
      break;
  }
  return "not run";
}

Json share(std::size_t hit, std::size_t all) { return {{"hit", hit}, {"all", all}}; }

Json to_json(const ClosureRow& row) {
  Json json{{"config", row.config}, {"hit", row.hit}, {"all", row.bins.size()}, {"hits", Json::object()}};
  for (const ClosureBin& bin : row.bins) json["hits"][bin.name] = bin.hits;
  return json;
}

/// "closed"; "open": a bin without a hit, or a failed test; "not run": it has only tests, and none ran.
std::string status_of(std::size_t hit, std::size_t all, const std::vector<const ClosureTest*>& tests) {
  const auto any = [&](TestOutcome outcome) {
    return std::any_of(tests.begin(), tests.end(), [&](const auto* test) { return test->outcome == outcome; });
  };
  if (hit < all || any(TestOutcome::Failed)) return "open";
  return all > 0 || any(TestOutcome::Passed) ? "closed" : "not run";
}

Json to_json(const Testpoint& point, const Closure& closure) {
  Json configurations = Json::array(), listed = Json::array();
  std::size_t hit = 0, all = 0;
  for (const ClosureRow& row : closure.rows) {
    if (row.testpoint != point.name) continue;
    hit += row.hit;
    all += row.bins.size();
    configurations.push_back(to_json(row));
  }
  std::vector<const ClosureTest*> tests;
  for (const ClosureTest& test : closure.tests) {
    if (test.testpoint != point.name) continue;
    tests.push_back(&test);
    listed.push_back({{"test", test.test}, {"runs", test.runs}, {"outcome", json_word(test.outcome)}});
  }
  return {{"name", point.name},
          {"proves", point.proves},
          {"status", status_of(hit, all, tests)},
          {"campaigns", point.campaigns},
          {"assertions", point.assertions},
          {"faults", point.faults},
          {"bins", share(hit, all)},
          {"configurations", std::move(configurations)},
          {"tests", std::move(listed)}};
}

/// Reason why an unreached point is excused; nothing if it was reached or is not excused.
const std::string* excuse(const LinePoint& point, const LineClosure& lines) {
  for (const LineFinding& found : lines.unreached) {
    if (found.point.file == point.file && found.point.line == point.line && found.point.column == point.column &&
        found.point.kind == point.kind && !found.reason.empty())
      return &found.reason;
  }
  return nullptr;
}

struct LineCount {
  std::size_t reached = 0, excused = 0, all = 0;
};

Json to_json(const LineCount& count) {
  return {{"reached", count.reached}, {"excused", count.excused}, {"all", count.all}};
}

Json files_json(const LineClosure& lines, LineCount& total) {
  Json files = Json::array();
  for (const auto& [name, source] : lines.sources) {
    LineCount count;
    Json points = Json::array();
    for (const LinePoint& point : lines.points) {
      if (point.file != name) continue;
      const std::string* reason = point.hits == 0 ? excuse(point, lines) : nullptr;
      ++count.all;
      count.reached += point.hits > 0 ? 1 : 0;
      count.excused += reason != nullptr ? 1 : 0;
      Json entry{{"line", point.line}, {"kind", point.kind}, {"hits", point.hits}, {"lines", point.lines}};
      if (reason != nullptr) entry["excused"] = *reason;
      points.push_back(std::move(entry));
    }
    total.all += count.all;
    total.reached += count.reached;
    total.excused += count.excused;
    files.push_back({{"file", name}, {"count", to_json(count)}, {"points", std::move(points)}, {"source", source}});
  }
  return files;
}

Json tests_json(const std::vector<ClosureTest>& tests) {
  std::map<TestOutcome, std::size_t> count;
  for (const ClosureTest& test : tests) ++count[test.outcome];
  return {{"passed", count[TestOutcome::Passed]},
          {"failed", count[TestOutcome::Failed]},
          {"not_run", count[TestOutcome::NotRun]}};
}

}  // namespace

std::string closure_json(const ClosureReport& report) {
  CoverageBook sum;
  Json configurations = Json::array();
  for (const auto& [book, planned] : report.inputs) {
    std::size_t hit = 0, all = 0;
    for (const ClosureRow& row : report.closure.rows) {
      if (row.config != book.config) continue;
      hit += row.hit;
      all += row.bins.size();
    }
    sum.streams += book.streams;
    sum.splats += book.splats;
    sum.cycles += book.cycles;
    sum.comparisons += book.comparisons;
    configurations.push_back({{"config", book.config},
                              {"config_hash", hash_text(book.config_hash)},
                              {"bins", share(hit, all)},
                              {"streams", book.streams},
                              {"splats", book.splats},
                              {"cycles", book.cycles},
                              {"comparisons", book.comparisons}});
  }
  Json testpoints = Json::array();
  for (const Testpoint& point : report.plan.testpoints) testpoints.push_back(to_json(point, report.closure));
  LineCount lines;
  Json files = files_json(report.lines, lines);
  const Json json{
      {"verb", "closure"},
      {"version", report.version},
      {"verdict", report.closed() ? "closed" : "open"},
      {"bins", share(report.closure.hit, report.closure.bins)},
      {"lines", to_json(lines)},
      {"tests", tests_json(report.closure.tests)},
      {"streams", sum.streams},
      {"splats", sum.splats},
      {"cycles", sum.cycles},
      {"comparisons", sum.comparisons},
      {"open",
       {{"campaigns", report.failures}, {"testpoints", report.closure.findings}, {"lines", report.lines.findings}}},
      {"configurations", std::move(configurations)},
      {"testpoints", std::move(testpoints)},
      {"files", std::move(files)},
      {"command", report.command}};
  return json_text(json, 1) + "\n";
}

}  // namespace fastsplat::testbench
