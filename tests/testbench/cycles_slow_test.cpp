// SPDX-License-Identifier: Apache-2.0
// The cycle model at length: every pair of patterns, a head scan's cycles, and its speed against the clocked device.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "cmodel/cycles/cycle_model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/run_device.hpp"
#include "testbench/device/rtl_device.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/testbench/cycle_board_helper.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

class EachConfig : public ::testing::TestWithParam<std::string> {
 protected:
  cmodel::Config config() const { return driver::load_config(GetParam()); }
};

TEST_P(EachConfig, LongRandomStreamsUnderEveryPairOfPatterns) {
  Random random(seed_or(77));
  CycleComparison total;
  const auto patterns = Pattern::examples();
  std::uint64_t seed = 0;
  for (const auto& input : patterns) {
    for (const auto& output : patterns) {
      ++seed;
      const auto stream = random_stream(symbols_of(config()), random, 300);
      total += compare_cycles(config(), to_beats(stream.bytes), Pattern(input, seed), Pattern(output, seed + 1000));
      if (total.mismatches > 0) FAIL() << input << "/" << output << ": " << total.first;
    }
  }
  judge(GetParam() + " long random", total);
}

INSTANTIATE_TEST_SUITE_P(Rtl, EachConfig, ::testing::Values("tiny", "small", "base"),
                         [](const auto& param_info) { return param_info.param; });

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The same stream without taps or checking through both; best of three for the model, which takes milliseconds.
TEST(CycleModelSpeed, AHundredTimesTheClockedBase) {
  const cmodel::Config config = driver::load_config("base");
  scene::SceneDescription description;
  description.volume = "shells:16";
  description.width = description.height = 64;
  const auto beats = scene_beats(description, config);
  cmodel::NullPixels pixels;
  testbench::RtlOptions plain;
  plain.assertions = testbench::Assertions::Off;
  const auto rtl = testbench::make_rtl_device(config, pixels, plain);
  auto start = std::chrono::steady_clock::now();
  rtl->consume(beats);
  rtl->finish();
  const double rtl_seconds = seconds_since(start);

  double model_seconds = 1e9;
  std::uint64_t busy = 0;
  for (int turn = 0; turn < 3; ++turn) {
    cmodel::CycleModel model(config, cmodel::StreamScope::Subset);
    start = std::chrono::steady_clock::now();
    model.consume(beats);
    model.finish();
    model_seconds = std::min(model_seconds, seconds_since(start));
    busy = model.stalls().busy;
  }
  EXPECT_EQ(busy, rtl->cycle_counters().busy);
  const double ratio = rtl_seconds / model_seconds;
  std::printf(
      "[figure] cycle model: %.1f M beats/s, %.1f M cycles/s; Verilated base %.3f M cycles/s; ratio = %.0f (limit >= "
      "100)\n",
      static_cast<double>(beats.size()) / model_seconds / 1e6, static_cast<double>(busy) / model_seconds / 1e6,
      static_cast<double>(busy) / rtl_seconds / 1e6, ratio);
  RecordProperty("speed_ratio", std::to_string(ratio));
  EXPECT_GE(ratio, 100.0);
}

// Before the decoder checked rules, beats had 256 bits and pixels had their own registers: this frame had 8,786,660
// windows and cost 1.004 times as many cycles. None of these may cost more.
TEST(HeadScan, CostsNoMoreCyclesThanTheDeviceThatTrustedItsStream) {
  constexpr std::uint64_t kWindowsThen = 8'786'660;
  constexpr double kRatioThen = 1.004;

  if (!std::filesystem::exists("/usr/share/mricron/templates/ch2bet.nii.gz"))
    GTEST_SKIP() << "no head scan: install Debian's mricron-data";
  const cmodel::Config config = driver::load_config("base");
  scene::SceneDescription description;
  description.volume = "ch2bet";
  description.transfer_function = "mri-head";
  description.width = description.height = 256;
  cmodel::CycleAccount account;
  cmodel::StallCounters stalls;
  cmodel::Counters counters;
  driver::run_device(
      scene::build_scene(description), config,
      [&](cmodel::PixelSink&) { return std::make_unique<cmodel::CycleModel>(config, cmodel::StreamScope::Subset); }, {},
      [&](cmodel::Device& device) {
        const auto& model = dynamic_cast<const cmodel::CycleModel&>(device);
        account = model.account();
        stalls = model.stalls();
        counters = model.counters();
      });
  ASSERT_GT(account.ideal, 0U);
  const double ratio = static_cast<double>(stalls.busy) / static_cast<double>(account.ideal);
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "[figure] ch2bet 256x256 base: actual/ideal = %.5f (limit %.3f), %llu cycles (limit %.3f x %llu), %llu windows, "
      "%llu splats, %llu cycles of pictures going out\n",
      ratio, kRatioThen, number(stalls.busy), kRatioThen, number(kWindowsThen), number(counters.windows),
      number(counters.splats), number(account.pixels));
  RecordProperty("actual_to_ideal", std::to_string(ratio));
  EXPECT_EQ(account.total(), stalls.busy);
  EXPECT_LE(ratio, kRatioThen);
  EXPECT_LE(static_cast<double>(stalls.busy), kRatioThen * static_cast<double>(kWindowsThen));
}

}  // namespace
}  // namespace fastsplat::test
