// SPDX-License-Identifier: Apache-2.0
// Cycles in the checker: the cycle model runs beside every verified run, and one cycle too many is a failure.
#include <gtest/gtest.h>

#include <cstdio>

#include "driver/config/config_file.hpp"
#include "testbench/check/verify.hpp"
#include "testbench/device/passing_device.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {
namespace {

/// A device that reports one stall counter wrong.
class Miscounting final : public PassingDevice {
 public:
  Miscounting(std::unique_ptr<RtlDevice> device, std::uint64_t cmodel::StallCounters::*field)
      : PassingDevice(std::move(device)), field_(field) {}
  cmodel::StallCounters cycle_counters() override {
    cmodel::StallCounters cycles = PassingDevice::cycle_counters();
    ++(cycles.*field_);
    return cycles;
  }

 private:
  std::uint64_t cmodel::StallCounters::*field_;
};

VerifyOptions tiny_at_random() {
  VerifyOptions options;
  options.config = driver::load_config("tiny");
  options.ready = "random-50";
  options.input = "burst-16";
  options.seed = 7;
  return options;
}

BeatSource mixed(const cmodel::Config& config) {
  return source_of(write_document(config, make_stimulus(config, StimulusClass::Mixed, 3, 150).document));
}

TEST(CheckedCycles, ModelAndRtlAgreeUnderPatternsAndAfterAReset) {
  for (const std::uint64_t reset_after : {0u, 40u}) {
    VerifyOptions options = tiny_at_random();
    options.reset_after = reset_after;
    const auto result = verify(mixed(options.config), options);
    EXPECT_EQ(result.verdict, Verdict::Pass);
    ASSERT_TRUE(result.check.cycles_rtl && result.check.cycles_model);
    std::printf("[figure] reset after %llu beats: cycles of the RTL = %llu, of the model = %llu\n",
                static_cast<unsigned long long>(reset_after), static_cast<unsigned long long>(*result.check.cycles_rtl),
                static_cast<unsigned long long>(*result.check.cycles_model));
    EXPECT_EQ(*result.check.cycles_rtl, *result.check.cycles_model);
    EXPECT_GT(*result.check.cycles_rtl, 500u);
  }
}

TEST(CheckedCycles, OneCycleMoreInAnyCounterIsAMismatch) {
  using Cycles = cmodel::StallCounters;
  struct Counter {
    std::uint64_t Cycles::*field;
    const char* meaning;
  };
#define X(name, counter, meaning) Counter{&Cycles::name, meaning},
  for (const auto& [field, meaning] : {FASTSPLAT_STALL_COUNTERS(X)}) {
#undef X
    VerifyOptions options = tiny_at_random();
    options.device = [&, field = field](cmodel::PixelSink& pixels, const RtlOptions& rtl) {
      return std::make_unique<Miscounting>(make_rtl_device(options.config, pixels, rtl), field);
    };
    const auto result = verify(mixed(options.config), options);
    EXPECT_EQ(result.verdict, Verdict::Mismatch);
    EXPECT_EQ(result.check.mismatches, 1u);
    EXPECT_FALSE(result.check.first);
    EXPECT_EQ(result.check.detector, Detector::Cycles);
    ASSERT_EQ(result.check.differences.size(), 1u);
    EXPECT_EQ(result.check.differences[0].rfind(meaning, 0), 0u) << result.check.differences[0];
  }
}

TEST(CheckedCycles, AreAbsentOfARunThatDidNotEnd) {
  VerifyOptions options = tiny_at_random();
  options.ready = "always";
  options.timeout = 0;  // any wait is a hang
  const auto result = verify(mixed(options.config), options);
  EXPECT_EQ(result.verdict, Verdict::Simulation);
  EXPECT_FALSE(result.check.cycles_rtl);
  EXPECT_FALSE(result.check.cycles_model);
}

// A sink that is rarely ready takes a picture in a hundred times the longest wait of a device.
TEST(CheckedCycles, ASlowSinkIsNotAHang) {
  VerifyOptions options = tiny_at_random();
  options.ready = "every-100";
  options.input = "always";
  options.timeout = 400;
  const auto result = verify(mixed(options.config), options);
  EXPECT_EQ(result.verdict, Verdict::Pass) << result.error;
  ASSERT_TRUE(result.check.cycles_rtl);
  std::printf("[figure] cycles for a sink ready every 100th = %llu, without a transfer at most %llu\n",
              static_cast<unsigned long long>(*result.check.cycles_rtl),
              static_cast<unsigned long long>(options.timeout + 100));
  EXPECT_GT(*result.check.cycles_rtl, 20 * options.timeout);
}

// Devices in one thread are independent: the simulator keeps a context per thread.
TEST(VerilatedDevices, MayGoInAnyOrder) {
  const auto config = driver::load_config("tiny");
  cmodel::NullPixels pixels;
  RtlOptions plain;
  plain.assertions = Assertions::Off;
  for (int turn = 0; turn < 8; ++turn) {
    auto first = make_rtl_device(config, pixels), second = make_rtl_device(config, pixels, plain),
         third = make_rtl_device(config, pixels);
    third->warm_reset();
    third.reset();
    first->warm_reset();
    second.reset();
    first.reset();
  }
}

}  // namespace
}  // namespace fastsplat::testbench
