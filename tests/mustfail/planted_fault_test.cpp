// SPDX-License-Identifier: Apache-2.0
// Faults that `verify --fault` plants: plain random streams show each, and each can be shrunk.
#include "testbench/faults/planted_fault.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "base/error.hpp"
#include "testbench/faults/breakable_device.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "testbench/triage/failure.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

using Where = testbench::PlantedFault::Where;

testbench::CampaignOptions campaign(const testbench::PlantedFault* fault, const cmodel::Config& config) {
  testbench::CampaignOptions options{
      .verify = {.config = config, .ready = "all", .timeout = 20000, .wave = {}, .device = {}},
      .splats = 1000,
      .seeds = 8,
      .threads = 1,
      .progress = {}};
  if (fault != nullptr) options.verify.device = testbench::with_fault(*fault, config);
  return options;
}

TEST(PlantedFault, IsSeenByRandomStreams) {
  int in_rtl = 0, at_ports = 0;
  for (const auto& fault : testbench::planted_faults()) {
    const bool rtl = fault.where == Where::Rtl;
    const auto config = named_config(rtl ? std::string("faults/") + testbench::breakable_config(fault) : "tiny");
    const auto options = campaign(&fault, config);
    const auto result = testbench::run_campaign(options);
    ASSERT_TRUE(result.failed) << fault.name << " is not seen in " << result.streams << " streams";
    ++(rtl ? in_rtl : at_ports);
    // Faults that hang the device end as a failed simulation; the checker reports all others.
    EXPECT_EQ(result.total.verdict,
              std::string(fault.name) == "LOST_FREE" ? testbench::Verdict::Simulation : testbench::Verdict::Mismatch)
        << fault.name;
    std::printf("[figure] %s: seen in stream %zu, %s\n", fault.name, *result.failed + 1,
                testbench::first_divergence(*result.failure, config).c_str());
  }
  std::printf("[figure] faults seen = %d of the RTL, %d at the ports (limits >= 22, 9)\n", in_rtl, at_ports);
  EXPECT_GE(in_rtl, 22);
  EXPECT_GE(at_ports, 9);
}

TEST(PlantedFault, AtThePortsIsMadeSmall) {
  const auto config = named_config("tiny");
  const auto& fault = testbench::planted_fault_from("PORT_SHEET");
  auto options = campaign(&fault, config);
  options.classes = {testbench::StimulusClass::Mixed};
  const auto result = testbench::run_campaign(options);
  ASSERT_TRUE(result.failed);
  auto run = testbench::make_run(options, *result.failed);
  const auto report =
      testbench::investigate(testbench::source_of(std::move(run.beats)), run.options, *result.failure, {}, 200);
  std::printf("[figure] splats of the smallest stream = %llu (expected 7)\n",
              static_cast<unsigned long long>(report.shrink.splats_after));
  EXPECT_EQ(report.shrink.splats_after, 7u) << "the seventh is the first that is wrong";
  EXPECT_NE(report.divergence.find("stage sheet"), std::string::npos) << report.divergence;
}

TEST(PlantedFault, WithoutOneTheSameStreamsPass) {
  const auto config = named_config("faults/mustfail");
  auto options = campaign(nullptr, config);
  options.verify.device = [&](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
    return testbench::make_breakable_device(config, pixels, rtl, testbench::RtlFault::None, testbench::Assertions::On);
  };
  const auto result = testbench::run_campaign(options);
  EXPECT_FALSE(result.failed);
  EXPECT_GT(result.total.check.comparisons, 1000u);
}

TEST(PlantedFault, AnUnknownOneIsRefusedWithTheNearest) {
  try {
    testbench::planted_fault_from("FORWARD_4");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    EXPECT_NE(std::string(error.what()).find("did you mean 'FORWARD_"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace fastsplat::test
