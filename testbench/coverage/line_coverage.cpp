// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/line_coverage.hpp"

#include <algorithm>
#include <sstream>

#include "base/error.hpp"
#include "base/read_file.hpp"

namespace fastsplat::testbench {
namespace {

[[noreturn]] void refuse(const std::string& line) {
  throw_input({.where = "coverage.dat",
               .what = "not a line written by Verilator",
               .expected = "C '<keys>' <count>",
               .got = line.substr(0, 80),
               .fix = {}});
}

/// A record's keys: \x01 key \x02 value, one after the other.
std::map<std::string, std::string> keys_of(const std::string& text) {
  std::map<std::string, std::string> keys;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, '\x01');) {
    const auto middle = part.find('\x02');
    if (middle != std::string::npos) keys[part.substr(0, middle)] = part.substr(middle + 1);
  }
  return keys;
}

/// "3-4,9" -> 3 4 9
std::vector<int> lines_of(const std::string& text) {
  std::vector<int> lines;
  std::istringstream ranges(text);
  for (std::string range; std::getline(ranges, range, ',');) {
    const auto dash = range.find('-');
    const int from = std::stoi(range), to = dash == std::string::npos ? from : std::stoi(range.substr(dash + 1));
    for (int line = from; line <= to; ++line) lines.push_back(line);
  }
  return lines;
}

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t"), to = text.find_last_not_of(" \t\r");
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

}  // namespace

void LineCoverage::add(const std::string& dat) {
  std::istringstream records(dat);
  for (std::string line; std::getline(records, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto end = line.rfind("' ");
    if (!line.starts_with("C '") || end == std::string::npos) refuse(line);
    auto keys = keys_of(line.substr(3, end - 3));
    const std::uint64_t hits = std::stoull(line.substr(end + 2));
    if (keys["page"].starts_with("v_user/")) {
      user_[keys["o"]] += hits;
      continue;
    }
    const std::string kind = keys["o"] == "block" ? "line" : keys["o"];
    LinePoint& point = points_[keys["f"] + ":" + keys["l"] + ":" + keys["n"] + ":" + kind];
    if (point.kind.empty()) {
      point.file = std::filesystem::path(keys["f"]).filename();
      point.line = std::stoi(keys["l"]);
      point.column = std::stoi(keys["n"]);
      point.kind = kind;
      point.lines = lines_of(keys["S"]);
    }
    point.hits += hits;
  }
}

void LineCoverage::merge(const LineCoverage& other) {
  for (const auto& [place, point] : other.points_) {
    const auto [at, added] = points_.try_emplace(place, point);
    if (!added) at->second.hits += point.hits;
  }
  for (const auto& [name, hits] : other.user_) user_[name] += hits;
}

std::vector<LinePoint> LineCoverage::points() const {
  std::vector<LinePoint> out;
  for (const auto& [place, point] : points_) out.push_back(point);
  std::sort(out.begin(), out.end(), [](const LinePoint& a, const LinePoint& b) {
    return std::tie(a.file, a.line, a.column, a.kind) < std::tie(b.file, b.line, b.column, b.kind);
  });
  return out;
}

std::map<std::string, std::filesystem::path> sources_in(const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::path> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) out[entry.path().filename()] = entry.path();
  return out;
}

LineClosure close_lines(const LineCoverage& coverage, const std::filesystem::path& rtl,
                        const std::vector<LineExclusion>& exclusions) {
  LineClosure out;
  const auto sources = sources_in(rtl);
  for (const LinePoint& point : coverage.points()) {
    const auto source = sources.find(point.file);
    if (source == sources.end()) continue;  // a generated package
    out.points.push_back(point);
    if (out.sources.contains(point.file)) continue;
    std::istringstream text(read_text_file(source->second));
    auto& lines = out.sources[point.file];
    for (std::string line; std::getline(text, line);) lines.push_back(line);
  }
  if (out.points.empty()) out.findings.push_back("no lines of rtl/ were checked");
  std::vector<int> used(exclusions.size(), 0);
  for (const LinePoint& point : out.points) {
    const auto& lines = out.sources[point.file];
    const auto number = static_cast<std::size_t>(point.line);
    const std::string text = number <= lines.size() ? trimmed(lines[number - 1]) : "";
    const std::string place = point.file + ":" + std::to_string(point.line) + " (" + point.kind + "): " + text;
    LineFinding finding{point, text, {}};
    for (std::size_t i = 0; i < exclusions.size(); ++i) {
      const LineExclusion& exclusion = exclusions[i];
      if (exclusion.file != point.file || exclusion.line != text || exclusion.kind != point.kind) continue;
      ++used[i];
      finding.reason = exclusion.reason;
      if (point.hits > 0) out.findings.push_back("excluded, but reached: " + place);
    }
    if (point.hits > 0) continue;
    if (finding.reason.empty()) out.findings.push_back("never reached: " + place);
    out.unreached.push_back(std::move(finding));
  }
  for (std::size_t i = 0; i < exclusions.size(); ++i) {
    if (used[i] == 0)
      out.findings.push_back("excluded, but missing: " + exclusions[i].file + ": " + exclusions[i].line);
  }
  return out;
}

}  // namespace fastsplat::testbench
