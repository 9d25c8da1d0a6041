// SPDX-License-Identifier: Apache-2.0
// Coverage closure: whether every testpoint of the plan is decided and every bin hit where the plan requires it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "testbench/closure/verification_plan.hpp"
#include "testbench/coverage/coverage_book.hpp"

namespace fastsplat::testbench {

/// A bin as a testpoint sees it: hits in the testpoint's campaigns only.
struct ClosureBin {
  std::string name;
  std::uint64_t hits = 0;
};

/// A testpoint on one configuration.
struct ClosureRow {
  std::string testpoint, config;
  std::vector<ClosureBin> bins;
  std::size_t hit = 0;  ///< bins that were hit
};

enum class TestOutcome { NotRun, Passed, Failed };

struct ClosureTest {
  std::string testpoint, test;
  TestOutcome outcome = TestOutcome::NotRun;
  std::size_t runs = 0;  ///< number of its parameters that ran
};

struct Closure {
  std::vector<ClosureRow> rows;
  std::vector<ClosureTest> tests;
  std::vector<std::string> findings;  ///< why the coverage is open; empty: closed
  std::size_t bins = 0, hit = 0;      ///< over all rows
};

/// Coverage of one configuration.
struct ClosureInput {
  CoverageBook book;
  Coverage planned;  ///< every bin that has to be hit (planned_bins, and cover points where they were collected)
};

/// A finding for each stimulus class of which the book has no streams.
std::vector<std::string> classes_without_streams(const CoverageBook& book);

/// `results`: names of tests that ran, as ctest knows them, and whether they passed. If it is empty, tests are ignored.
/// Otherwise a testpoint that has only tests needs one that passed.
Closure close_coverage(const VerificationPlan& plan, const std::vector<ClosureInput>& inputs,
                       const std::map<std::string, bool>& results);

/// Campaign under which cover points are kept: they are counted over a whole configuration.
inline constexpr const char* kCoverPoints = "rtl";

/// Whether ctest's name for a test belongs to the plan's (`testbench.Suite.Name` is `testbench.Inst/Suite.Name/param`).
bool is_test(const std::string& planned, const std::string& ctest_name);
/// A regular expression for ctest that matches the plan's tests.
std::string tests_expression(const VerificationPlan& plan);

/// Names and verdicts of a JUnit file of ctest.
std::map<std::string, bool> read_test_results(const std::filesystem::path& path);

}  // namespace fastsplat::testbench
