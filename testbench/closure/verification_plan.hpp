// SPDX-License-Identifier: Apache-2.0
// The verification plan (docs/verification_plan.toml): testpoint -> what it proves -> campaigns and tests -> bins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "testbench/coverage/line_coverage.hpp"

namespace fastsplat::testbench {

struct Testpoint {
  std::string name;
  std::string proves;
  /// Where its bins have to be hit: stimulus classes, `scene`, `resets`, `registers`, `refusals`, or `all` of them.
  std::vector<std::string> campaigns;
  /// Tests that decide it: `folder.Suite.Name` (all its parameters), or `rtl.NAME` of tests/rtl/CMakeLists.txt.
  std::vector<std::string> tests;
  std::vector<std::string> bins;        ///< `group.name`; `*` stands for anything
  std::vector<std::string> configs;     ///< empty: every configuration that has such bins
  std::vector<std::string> assertions;  ///< names in rtl/
  std::vector<std::string> faults;      ///< names in testbench/faults/faults.def
};

struct VerificationPlan {
  std::vector<Testpoint> testpoints;
};

/// Throws UserError (Input) with line and column for unknown keys, wrong types and testpoints without evidence.
VerificationPlan read_plan(const std::filesystem::path& path);

/// Whether `pattern`, in which `*` stands for any text, matches.
bool matches(const std::string& pattern, const std::string& text);

/// Reads docs/coverage_exclusions.toml.
std::vector<LineExclusion> read_exclusions(const std::filesystem::path& path);

}  // namespace fastsplat::testbench
