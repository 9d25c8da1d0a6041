// SPDX-License-Identifier: Apache-2.0
#include "testbench/closure/closure.hpp"

#include <algorithm>
#include <regex>
#include <set>
#include <string_view>

#include "base/read_file.hpp"
#include "testbench/closure/coverage_campaigns.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {
namespace {

std::set<std::string> campaign_names() {
  std::set<std::string> names{kAllCampaigns};
  for (const StimulusClass which : stimulus_classes()) names.insert(to_string(which));
  for (const char* name : kOtherCampaigns) names.insert(name);
  return names;
}

std::uint64_t hits_of(const Testpoint& point, const CoverageBook& book, const std::string& bin) {
  std::uint64_t hits = 0;
  const bool all = std::find(point.campaigns.begin(), point.campaigns.end(), kAllCampaigns) != point.campaigns.end();
  for (const auto& [campaign, coverage] : book.campaigns) {
    if (all || campaign == kCoverPoints ||
        std::find(point.campaigns.begin(), point.campaigns.end(), campaign) != point.campaigns.end())
      hits += coverage.hits(bin);
  }
  return hits;
}

bool has_config(const Testpoint& point, const std::string& config) {
  return point.configs.empty() || std::find(point.configs.begin(), point.configs.end(), config) != point.configs.end();
}

bool planned(const Testpoint& point, const std::string& bin) {
  return std::any_of(point.bins.begin(), point.bins.end(), [&](const auto& pattern) { return matches(pattern, bin); });
}

ClosureRow row_of(const Testpoint& point, const ClosureInput& input) {
  ClosureRow row{.testpoint = point.name, .config = input.book.config, .bins = {}};
  for (const CoverBin& bin : input.planned.bins()) {
    if (!planned(point, bin.name)) continue;
    row.bins.push_back({bin.name, hits_of(point, input.book, bin.name)});
    if (row.bins.back().hits > 0) ++row.hit;
  }
  return row;
}

/// Checks the bins against the plan and the plan against the bins.
void check_mapping(const VerificationPlan& plan, const std::vector<ClosureInput>& inputs,
                   std::vector<std::string>& findings) {
  for (const ClosureInput& input : inputs) {
    const std::string& config = input.book.config;
    for (const CoverBin& bin : input.planned.bins()) {
      if (std::none_of(plan.testpoints.begin(), plan.testpoints.end(),
                       [&](const Testpoint& point) { return has_config(point, config) && planned(point, bin.name); }))
        findings.push_back(config + ": bin " + bin.name + " belongs to no testpoint");
    }
    for (const auto& [campaign, coverage] : input.book.campaigns) {
      for (const CoverBin& bin : coverage.bins()) {
        if (!input.planned.declared(bin.name))
          findings.push_back(config + ", " + campaign + ": bin " + bin.name + " is not declared");
      }
    }
  }
  const auto known = campaign_names();
  for (const Testpoint& point : plan.testpoints) {
    for (const auto& campaign : point.campaigns) {
      if (!known.contains(campaign)) findings.push_back(point.name + ": unknown campaign " + campaign);
    }
    for (const auto& pattern : point.bins) {
      const auto declares = [&](const ClosureInput& input) {
        return has_config(point, input.book.config) &&
               std::any_of(input.planned.bins().begin(), input.planned.bins().end(),
                           [&](const CoverBin& bin) { return matches(pattern, bin.name); });
      };
      // Cover points are there only where line coverage was collected.
      if (pattern.starts_with("cover.") && std::none_of(inputs.begin(), inputs.end(), [](const ClosureInput& input) {
            return input.book.campaigns.contains(kCoverPoints);
          }))
        continue;
      if (std::none_of(inputs.begin(), inputs.end(), declares))
        findings.push_back(point.name + ": unknown bin " + pattern);
    }
  }
}

}  // namespace

std::vector<std::string> classes_without_streams(const CoverageBook& book) {
  std::vector<std::string> findings;
  for (const StimulusClass which : stimulus_classes()) {
    if (!book.campaigns.contains(to_string(which)))
      findings.push_back(book.config + ": no streams of class " + to_string(which));
  }
  return findings;
}

Closure close_coverage(const VerificationPlan& plan, const std::vector<ClosureInput>& inputs,
                       const std::map<std::string, bool>& results) {
  Closure out;
  check_mapping(plan, inputs, out.findings);
  for (const Testpoint& point : plan.testpoints) {
    for (const ClosureInput& input : inputs) {
      if (!has_config(point, input.book.config)) continue;
      ClosureRow row = row_of(point, input);
      if (row.bins.empty()) continue;
      out.bins += row.bins.size();
      out.hit += row.hit;
      for (const ClosureBin& bin : row.bins) {
        if (bin.hits == 0) out.findings.push_back(point.name + ", " + row.config + ": " + bin.name + " was never hit");
      }
      out.rows.push_back(std::move(row));
    }
    bool decided = !point.bins.empty() || results.empty();
    for (const auto& test : point.tests) {
      ClosureTest line{.testpoint = point.name, .test = test};
      for (const auto& [name, passed] : results) {
        if (!is_test(test, name)) continue;
        ++line.runs;
        if (!passed)
          line.outcome = TestOutcome::Failed;
        else if (line.outcome == TestOutcome::NotRun)
          line.outcome = TestOutcome::Passed;
      }
      if (line.outcome == TestOutcome::Passed) decided = true;
      if (line.outcome == TestOutcome::Failed) out.findings.push_back(point.name + ": test " + test + " fails");
      out.tests.push_back(std::move(line));
    }
    if (!decided) out.findings.push_back(point.name + ": no test passed, and there are no bins");
  }
  if (out.bins == 0) out.findings.push_back("no bins were checked");
  return out;
}

bool is_test(const std::string& planned, const std::string& ctest_name) {
  const auto dot = planned.find('.');
  const std::string folder = planned.substr(0, dot + 1), test = planned.substr(dot + 1);
  if (!ctest_name.starts_with(folder)) return false;
  std::string name = ctest_name.substr(folder.size());
  // Instance/Suite.Name/parameter
  const auto at = name.find(test);
  if (at == std::string::npos || (at > 0 && name[at - 1] != '/')) return false;
  const auto end = at + test.size();
  return end == name.size() || name[end] == '/';
}

std::string tests_expression(const VerificationPlan& plan) {
  // No parentheses: ctest accepts only a few. Matching other tests, too, does no harm.
  std::set<std::string> names;
  for (const Testpoint& point : plan.testpoints) {
    for (const auto& test : point.tests) {
      const auto dot = test.find('.');
      names.insert("^" + test.substr(0, dot) + "[.].*" +
                   std::regex_replace(test.substr(dot + 1), std::regex("[.]"), "[.]"));
    }
  }
  std::string out;
  for (const auto& name : names) out += (out.empty() ? "" : "|") + name;
  return out;
}

std::map<std::string, bool> read_test_results(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, std::size_t{1} << 26);
  std::map<std::string, bool> out;
  // No std::regex: it recurses over every character of a name.
  const std::string begin = "<testcase name=\"", mark = " status=\"";
  for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    const auto name_end = std::min(text.find('"', at), text.size());
    const std::string_view rest = std::string_view(text).substr(name_end, text.find('>', name_end) - name_end);
    const auto status_at = rest.find(mark);
    if (status_at == std::string_view::npos) continue;
    const auto word = rest.substr(status_at + mark.size());
    const auto status = word.substr(0, word.find('"'));
    if (status == "run" || status == "fail") out[text.substr(at, name_end - at)] = status == "run";
  }
  return out;
}

}  // namespace fastsplat::testbench
