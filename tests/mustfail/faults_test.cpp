// SPDX-License-Identifier: Apache-2.0
// Every fault of faults.def is first seen by its named detector; the healthy device passes the same stimuli.
#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>
#include <string>

#include "testbench/faults/planted_fault.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/mustfail/campaign_helper.hpp"

namespace fastsplat::test {
namespace {

/// Beside configs/, which holds only the products.
std::string config_of(const char* fault) {
  return std::string("faults/") + breakable_config(testbench::planted_fault_from(fault));
}

constexpr const char* kNone = nullptr;

struct Row {
  Fault fault;
  const char* name;
  Detector detector;
  Stimulus stimulus;
  const char* assertion;
  const char* meaning;
};
void PrintTo(const Row& row, std::ostream* out) { *out << row.meaning; }
constexpr Row kRows[] = {
#define FAULT(name, detector, stimulus, assertion, meaning) \
  {Fault::name, #name, Detector::detector, Stimulus::stimulus, assertion, meaning},
#include "testbench/faults/faults.def"
#undef FAULT
};
/// Minimum size of a suite of injected faults.
constexpr std::size_t kFewestFaults = 12;
static_assert(std::size(kRows) >= kFewestFaults);

class MustFail : public ::testing::TestWithParam<Row> {};

TEST_P(MustFail, IsCaughtByItsDetector) {
  const Row& row = GetParam();
  const Outcome outcome = run(named_config(config_of(row.name)), row.stimulus, faulty(row.fault, Assertions::Off));
  ASSERT_TRUE(outcome.caught.has_value())
      << "SURVIVED: " << row.meaning << " (" << outcome.comparisons << " comparisons)";
  std::printf("[figure] %s: %s; caught by %s after %llu comparisons\n    %s\n", row.name, row.meaning,
              to_string(outcome.caught->by), static_cast<unsigned long long>(outcome.comparisons),
              outcome.caught->report.c_str());
  EXPECT_STREQ(to_string(outcome.caught->by), to_string(row.detector)) << outcome.caught->report;
}

TEST_P(MustFail, IsCaughtByItsAssertion) {
  const Row& row = GetParam();
  const Outcome outcome = run(named_config(config_of(row.name)), row.stimulus, faulty(row.fault, Assertions::On));
  ASSERT_TRUE(outcome.caught.has_value()) << "SURVIVED: " << row.meaning;
  if (row.assertion == kNone) {
    // Any detector is right, but must be listed in the table.
    EXPECT_STREQ(to_string(outcome.caught->by), to_string(row.detector)) << outcome.caught->report;
    return;
  }
  std::printf("[figure] %s: %s; after %llu comparisons: %s\n", row.name, row.meaning,
              static_cast<unsigned long long>(outcome.comparisons), outcome.caught->report.c_str());
  EXPECT_STREQ(to_string(outcome.caught->by), to_string(Detector::Assertion)) << outcome.caught->report;
  EXPECT_NE(outcome.caught->report.find(std::string(": assertion ") + row.assertion + " of the RTL failed in "),
            std::string::npos)
      << outcome.caught->report;
}

INSTANTIATE_TEST_SUITE_P(Fault, MustFail, ::testing::ValuesIn(kRows), [](const auto& row) { return row.param.name; });

void passes(const char* what, const std::string& config, const MakeDevice& make) {
  for (const Stimulus stimulus : kStimuli) {
    const Outcome outcome = run(named_config(config), stimulus, make);
    EXPECT_FALSE(outcome.caught.has_value()) << what << ", " << to_string(stimulus) << ": "
                                             << to_string(outcome.caught->by) << ": " << outcome.caught->report;
    EXPECT_GT(outcome.comparisons, 1000U) << to_string(stimulus);
    std::printf("[figure] %s, %s: %llu comparisons (limit > 1000), %d mismatches\n", what, to_string(stimulus),
                static_cast<unsigned long long>(outcome.comparisons), outcome.caught.has_value() ? 1 : 0);
  }
}

TEST(MustPass, TheBreakableDeviceWithNoFaultSelected) {
  for (const char* fault : {"FORWARD_1", "SAMPLE_STALL", "CULL_CORNER", "POST_STEPS"})
    passes("no fault selected", config_of(fault), faulty(Fault::None, Assertions::On));
}
TEST(MustPass, TheDeviceItself) { passes("the device itself, tiny", "tiny", testbench::make_rtl_device); }

}  // namespace
}  // namespace fastsplat::test
