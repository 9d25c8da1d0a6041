// SPDX-License-Identifier: Apache-2.0
// The device that composites every sample, whole and with its assertions on: every event in the cycle model's cycle,
// and windows wait as docs/microarchitecture.md requires (M-hazard-3). It is the device of the must-fail suite without
// a selected fault.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "testbench/device/tap_assembly.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/mustfail/campaign_helper.hpp"
#include "tests/testbench/cycle_board_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

cmodel::Config westover() { return named_config(std::string("faults/") + testbench::kBreakableSamples); }

TEST(EverySample, EachEventHappensInItsCycle) {
  const cmodel::Config config = westover();
  Random random(seed_or(91));
  CycleComparison total;
  std::uint64_t hazards = 0, seed = 0;
  for (const std::string& input : Pattern::examples()) {
    for (const std::string& output : Pattern::examples()) {
      ++seed;
      const auto hot = testbench::make_stimulus(config, testbench::StimulusClass::Hazards, seed, 60);
      const auto beats = seed % 2 == 0 ? testbench::write_document(config, hot.document)
                                       : to_beats(random_stream(symbols_of(config), random, 60).bytes);
      const auto one = compare_cycles(config, beats, Pattern(input, seed), Pattern(output, seed + 1000),
                                      faulty(Fault::None, Assertions::On));
      total += one;
      hazards += one.stalls.stall_hazard;
      // Windows of every sample and of sheets, ellipses among them, in their cycles: M-sample-1, M-sample-3,
      // M-sample-5, M-ellipse-1, M-ellipse-2, M-hazard-3.
      ASSERT_EQ(one.mismatches, 0U) << input << "/" << output << ": " << one.first;
    }
  }
  std::printf("[figure] cycles in which a window waited = %llu (limit > 50)\n",
              static_cast<unsigned long long>(hazards));
  EXPECT_GT(hazards, 50U);
  judge("every sample, random", total);
}

TEST(EverySample, RandomStreamsOfEveryClass) {
  testbench::CampaignOptions options{.verify = {.config = westover(), .ready = "all", .wave = {}, .device = {}},
                                     .splats = 6000,
                                     .seeds = 3,
                                     .threads = 1,
                                     .progress = {}};
  options.verify.device = [&](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
    return faulty(Fault::None, Assertions::On)(options.verify.config, pixels, rtl);
  };
  for (const char* input : {"always", "random-60"}) {
    options.verify.input = input;
    const auto result = testbench::run_campaign(options);
    EXPECT_FALSE(result.failed) << input << ": stream " << *result.failed;
    std::printf("[figure] every sample, input %s: comparisons = %llu (limit > 100000), mismatches = %llu (limit 0)\n",
                input, static_cast<unsigned long long>(result.total.check.comparisons),
                static_cast<unsigned long long>(result.total.check.mismatches));
    EXPECT_GT(result.total.check.comparisons, 100000U);
    // Every word and counter (M-sample-2, M-sample-4, M-hazard-1, M-hazard-2), sheets after samples too (M-sample-6).
    EXPECT_EQ(result.total.check.mismatches, 0U);
  }
}

/// Splats of one window on places `apart` pixels from one another, in turn; the RTL's own cycles.
struct Measured {
  std::uint64_t windows = 0, cycles = 0, hazards = 0;
};
Measured in_turn(const cmodel::Config& config, int places, int apart) {
  constexpr int kSplats = 200;
  StreamWriter w(symbols_of(config));
  w.begin_frame(config.tile_width, config.tile_height, 1);
  w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), 1));
  w.load_table(2, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1, 1));
  const auto words = static_cast<std::size_t>(config.lanes) * static_cast<std::size_t>(config.phases);
  w.load_table(0, 0, static_cast<std::uint32_t>(words / 2), 0, std::vector<std::uint32_t>(words, 0));
  w.begin_tile(5, 0, 0, 0, config.tile_width, config.tile_height);
  w.begin_sheet(0);
  for (int i = 0; i < kSplats; ++i)
    w.splat(0, (1 + i % places * apart) << config.position_frac_bits, 4 << config.position_frac_bits, {9, 9, 9, 9});
  w.end_sheet();
  w.end_tile();
  w.end_frame();

  struct Span final : cmodel::TapSink {
    std::uint64_t first = 0, last = 0, count = 0;
    void on_tap(const cmodel::TapRecord& record) override {
      if (record.tap != cmodel::Tap::Composite) return;
      if (count++ == 0) first = record.cycle;
      last = record.cycle;
    }
  } span;
  cmodel::NullPixels pixels;
  testbench::RtlOptions options;
  testbench::TapAssembly taps(config, pixels, span);
  options.taps = &taps;
  const auto rtl = faulty(Fault::None, Assertions::On)(config, pixels, options);
  rtl->consume(to_beats(w.bytes()));
  rtl->finish();
  EXPECT_EQ(span.count, static_cast<std::uint64_t>(kSplats));
  return {.windows = span.count, .cycles = span.last - span.first + 1, .hazards = rtl->cycle_counters().stall_hazard};
}

TEST(EverySample, WindowsWaitAsThePageSays) {
  const cmodel::Config config = westover();
  for (int places = 1; places <= 6; ++places) {
    for (const int apart : {config.lanes - 1, config.lanes}) {
      const Measured measured = in_turn(config, places, apart);
      // Windows at one place, or a pixel too near, wait for the previous one; windows back at the first place, with
      // others between, do not.
      std::uint64_t waits = 0;
      for (std::uint64_t i = 1; i < measured.windows; ++i) {
        const auto at = [&](std::uint64_t n) { return static_cast<int>(n) % places * apart; };
        if (std::abs(at(i) - at(i - 1)) < config.lanes) ++waits;
      }
      std::printf(
          "[figure] %d places %d pixels apart: %llu windows in %llu cycles, of which %llu waited (expected %llu)\n",
          places, apart, static_cast<unsigned long long>(measured.windows),
          static_cast<unsigned long long>(measured.cycles), static_cast<unsigned long long>(measured.hazards),
          static_cast<unsigned long long>(waits));
      EXPECT_EQ(measured.hazards, waits);  // M-hazard-3
      EXPECT_EQ(measured.cycles, measured.windows + waits);
    }
  }
}

}  // namespace
}  // namespace fastsplat::test
