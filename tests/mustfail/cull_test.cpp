// SPDX-License-Identifier: Apache-2.0
// The culling device, whole and with its assertions on: every event in the cycle model's cycle, every tap the model's.
// It is the device of the must-fail suite without a selected fault.
#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/model.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/mustfail/campaign_helper.hpp"
#include "tests/testbench/cycle_board_helper.hpp"
#include "tests/testbench/directed_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

cmodel::Config culling() { return named_config(std::string("faults/") + testbench::kBreakableCull); }

// Windows in their cycles, none of them hidden (M-cull-6, M-cull-7); sheets that wait for tables (M-cull-3, M-cull-4,
// M-cull-8, M-cull-9, M-cull-10, M-cull-12); the counters of both (M-register-17).
TEST(Culling, EachEventHappensInItsCycle) {
  const cmodel::Config config = culling();
  Random random(seed_or(97));
  CycleComparison total;
  std::uint64_t seed = 0;
  for (const std::string& input : Pattern::examples()) {
    for (const std::string& output : Pattern::examples()) {
      if (++seed % 2 == 0) continue;
      const auto beats = to_beats(random_stream(symbols_of(config), random, 60).bytes);
      const auto one = compare_cycles(config, beats, Pattern(input, seed), Pattern(output, seed + 1000),
                                      faulty(Fault::None, Assertions::On));
      total += one;
      ASSERT_EQ(one.mismatches, 0U) << input << "/" << output << ": " << one.first;
    }
  }
  std::printf("[figure] cycles of hidden splats and windows = %llu (limit > 250), of waits for a table = %llu (> 25)\n",
              static_cast<unsigned long long>(total.account.hidden),
              static_cast<unsigned long long>(total.account.map));
  EXPECT_GT(total.account.hidden, 250U);
  EXPECT_GT(total.account.map, 25U);
  judge("culling, random", total);
}

// Whatever the ready patterns, the model's words (M-cull-2, M-cull-13) and its verdicts, each in its cycle (M-cull-4,
// M-port-8); in tiles without tests nothing is hidden (M-port-9).
TEST(Culling, RandomStreamsOfEveryClass) {
  testbench::CampaignOptions options{.verify = {.config = culling(), .ready = "all", .wave = {}, .device = {}},
                                     .splats = 6000,
                                     .seeds = 2,
                                     .threads = 1,
                                     .progress = {}};
  options.verify.device = [&](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
    return faulty(Fault::None, Assertions::On)(options.verify.config, pixels, rtl);
  };
  options.verify.input = "all";
  const auto result = testbench::run_campaign(options);
  EXPECT_FALSE(result.failed) << "stream " << *result.failed;
  std::printf(
      "[figure] culling, streams of every class: comparisons = %llu (limit > 50000), mismatches = %llu (limit 0)\n",
      static_cast<unsigned long long>(result.total.check.comparisons),
      static_cast<unsigned long long>(result.total.check.mismatches));
  EXPECT_GT(result.total.check.comparisons, 50000U);
  EXPECT_EQ(result.total.check.mismatches, 0U);
}

// Successive frames as well, whose groups are hidden, sent (M-cull-14) and omitted (S-cull-9, S-cull-10, M-cull-15);
// tiles that end while a table is built (M-cull-11).
TEST(Culling, RefusesTheSameStreamsAsTheModel) {
  const cmodel::Config config = culling();
  const auto result =
      testbench::check_refusals(config, [&](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
        return faulty(Fault::None, Assertions::On)(config, pixels, rtl);
      });
  testbench::expect_all(result);
  const int refused = testbench::refused_streams(result);
  std::printf("[figure] culling: streams that break a rule, refused as the model refuses them = %d (limit >= 250)\n",
              refused);
  EXPECT_GE(refused, 250);
}

}  // namespace
}  // namespace fastsplat::test
