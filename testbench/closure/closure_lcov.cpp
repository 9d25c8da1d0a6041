// SPDX-License-Identifier: Apache-2.0
#include "testbench/closure/closure_lcov.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "base/json_text.hpp"
#include "base/read_file.hpp"

namespace fastsplat::testbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPlan = "docs/verification_plan.toml";

struct Tracefile {
  bool lines = false, branches = false;
  bool names = false;  ///< of branches: LCOV has numbers only
};

/// File -> its points; excused ones are left out.
std::map<std::string, std::vector<LinePoint>> points_by_file(const LineClosure& lines) {
  std::set<std::tuple<std::string, int, int, std::string>> excused;
  for (const LineFinding& found : lines.unreached) {
    if (!found.reason.empty())
      excused.insert({found.point.file, found.point.line, found.point.column, found.point.kind});
  }
  std::map<std::string, std::vector<LinePoint>> out;
  for (const LinePoint& point : lines.points) {
    if (!excused.contains({point.file, point.line, point.column, point.kind})) out[point.file].push_back(point);
  }
  return out;
}

std::string records(const LineClosure& lines, const std::filesystem::path& source, const Tracefile& kind) {
  const auto paths = sources_in(source / "rtl");
  std::string out = "TN:fastsplat\n";
  for (const auto& [file, points] : points_by_file(lines)) {
    out += "SF:" + std::filesystem::relative(paths.at(file), source).generic_string() + "\n";
    std::map<int, std::uint64_t> runs;            // of a line: those of the block that ran most
    std::map<std::pair<int, int>, int> branches;  // of a line and column so far
    for (const LinePoint& point : points) {
      for (const int line : point.lines) runs[line] = std::max(runs[line], point.hits);
      if (!kind.branches || point.kind == "line") continue;
      const int number = branches[{point.line, point.column}]++;
      out += fmt::format("BRDA:{},{},{},{}\n", point.line, point.column,
                         kind.names ? point.kind : std::to_string(number), point.hits);
    }
    if (kind.lines) {
      for (const auto& [line, hits] : runs) out += fmt::format("DA:{},{}\n", line, hits);
    }
    out += "end_of_record\n";
  }
  return out;
}

/// Testpoint -> line of its name in the plan, from 1.
std::map<std::string, int> lines_of_testpoints(const std::string& plan) {
  std::map<std::string, int> out;
  std::istringstream text(plan);
  const std::string name = "name = \"";
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.starts_with(name)) out[line.substr(name.size(), line.rfind('"') - name.size())] = number;
  }
  return out;
}

std::string bins(const ClosureReport& report, const std::string& plan) {
  const auto lines = lines_of_testpoints(plan);
  std::string out = fmt::format("TN:fastsplat\nSF:{}\n", kPlan);
  for (const ClosureRow& row : report.closure.rows) {
    const auto config = std::ranges::find(report.inputs, row.config, [](const auto& each) { return each.book.config; });
    for (const ClosureBin& bin : row.bins) {
      out += fmt::format("BRDA:{},{},{} {},{}\n", lines.at(row.testpoint), config - report.inputs.begin(), row.config,
                         bin.name, bin.hits);
    }
  }
  return out + "end_of_record\n";
}

}  // namespace

std::string closure_info(const ClosureReport& report, const std::filesystem::path& source) {
  return records(report.lines, source, {.lines = true, .branches = true});
}

std::map<std::string, std::string> coverview_files(const ClosureReport& report, const std::filesystem::path& source) {
  const std::string plan = read_text_file(source / kPlan);
  std::string sources = fmt::format("### FILE: {}\n{}", kPlan, plan);
  const auto paths = sources_in(source / "rtl");
  for (const auto& [file, points] : points_by_file(report.lines)) {
    const auto path = paths.at(file);
    sources +=
        fmt::format("### FILE: {}\n{}", std::filesystem::relative(path, source).generic_string(), read_text_file(path));
  }
  const Json config{
      {"title", "FastSplat coverage"},
      {"repo", "fastsplat"},
      {"commit", report.version},
      {"datasets",
       {{"rtl", {{"line", "lines.info"}, {"branch", "branches.info"}}}, {"plan", {{"bins", "bins.info"}}}}}};
  return {{"config.json", json_text(config, 1) + "\n"},
          {"sources.txt", sources},
          {"lines.info", records(report.lines, source, {.lines = true})},
          {"branches.info", records(report.lines, source, {.branches = true, .names = true})},
          {"bins.info", bins(report, plan)}};
}

}  // namespace fastsplat::testbench
