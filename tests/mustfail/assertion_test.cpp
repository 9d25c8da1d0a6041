// SPDX-License-Identifier: Apache-2.0
// An assertion of the RTL that fails inside `verify` is a fault of the simulation. One line reports its name, instance
// and cycle. It is shrunk and replayed like any other failure.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "base/error.hpp"
#include "testbench/device/failed_assertion.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "testbench/triage/failure.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/mustfail/campaign_helper.hpp"

namespace fastsplat::test {
namespace {

testbench::VerifyOptions broken(Fault fault, Assertions assertions) {
  testbench::VerifyOptions options;
  options.config = named_config("faults/mustfail");
  options.device = [=, config = options.config](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
    return faulty(fault, assertions)(config, pixels, rtl);
  };
  return options;
}

testbench::BeatSource swaps(const cmodel::Config& config) {
  return testbench::source_of(testbench::write_document(
      config, testbench::make_stimulus(config, testbench::StimulusClass::SwapHazards, 1, 200).document));
}

TEST(AssertionInVerify, IsASimulationFaultWithNameInstanceAndCycle) {
  const auto options = broken(Fault::EARLY_SWAP, Assertions::On);
  const auto result = testbench::verify(swaps(options.config), options);
  std::printf("[figure] %s\n", result.error.c_str());
  EXPECT_EQ(result.verdict, testbench::Verdict::Simulation);
  EXPECT_EQ(static_cast<int>(testbench::exit_code(result.verdict)), 5);
  EXPECT_EQ(result.check.mismatches, 0u);
  EXPECT_NE(result.error.find(
                "assertion sheet_has_one_owner of the RTL failed in fastsplat_dut.u_top.u_core.u_splat.gen_owner"),
            std::string::npos);
  EXPECT_NE(result.error.find("(fastsplat_splat_array.sv:"), std::string::npos);
  EXPECT_EQ(result.error.find('\n'), std::string::npos);
  EXPECT_EQ(result.error.rfind("cycle ", 0), 0u);
  const auto cycle = std::stoull(result.error.substr(6));
  EXPECT_EQ(cycle + 1, result.last_cycle);
}

TEST(AssertionInVerify, IsShrunk) {
  const auto options = broken(Fault::EARLY_SWAP, Assertions::On);
  const auto source = swaps(options.config);
  const auto failed = testbench::verify(source, options);
  ASSERT_EQ(failed.verdict, testbench::Verdict::Simulation);
  const auto report = testbench::investigate(source, options, failed, {}, 100);
  std::printf("[figure] splats = %llu of %llu; %s\n", static_cast<unsigned long long>(report.shrink.splats_after),
              static_cast<unsigned long long>(report.shrink.splats_before), report.divergence.c_str());
  EXPECT_LT(report.shrink.splats_after, report.shrink.splats_before / 10);
  EXPECT_NE(report.divergence.find("assertion sheet_has_one_owner"), std::string::npos) << report.divergence;
}

// The same fault, seen by the scoreboard where assertions are off: the two verdicts stay apart.
TEST(AssertionInVerify, IsNotNeededToSeeTheFault) {
  const auto options = broken(Fault::EARLY_SWAP, Assertions::Off);
  const auto result = testbench::verify(swaps(options.config), options);
  EXPECT_EQ(result.verdict, testbench::Verdict::Mismatch);
  EXPECT_EQ(result.error, "");
}

TEST(SimulatorOutput, FindsTheFirstFailedAssertion) {
  const auto failed = testbench::first_failed_assertion(
      "[0] %Error: a.sv:12: Assertion failed in TOP.core.u_a.held: held\n-Info: a.sv:12: Verilog $stop, ignored\n"
      "[0] %Error: b.sv:7: Assertion failed in TOP.core.u_b.other: other\n");
  EXPECT_EQ(failed.name, "held");
  EXPECT_EQ(failed.path, "core.u_a");
  EXPECT_EQ(failed.place, "a.sv:12");
  EXPECT_EQ(testbench::first_failed_assertion("nothing of the kind").name, "");
}

// Verilator prints to the thread's simulation context, which was that of a destroyed device.
TEST(AssertionOfADevice, ReportsAnErrorOfADeviceWhenALaterOneIsGone) {
  const auto options = broken(Fault::EARLY_SWAP, Assertions::On);
  cmodel::NullPixels pixels;
  const auto device = options.device(pixels, {});
  options.device(pixels, {}).reset();
  std::string message;
  try {
    swaps(options.config)([&](std::span<const cmodel::Beat> beats) { device->consume(beats); });
    device->finish();
  } catch (const UserError& error) {
    message = error.what();
  }
  std::printf("[figure] of a device older than one that is gone: %s\n", message.c_str());
  EXPECT_NE(message.find("assertion sheet_has_one_owner of the RTL failed in "), std::string::npos) << message;
}

}  // namespace
}  // namespace fastsplat::test
