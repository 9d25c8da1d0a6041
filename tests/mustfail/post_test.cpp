// The device whose weights lie between entries of its radial table, whole and with its assertions on: every event in the
// cycle model's cycle, every word the model's. The device is that of the must-fail suite with no fault selected.
#include <gtest/gtest.h>

#include <cstdio>

#include "testbench/stimulus/campaign.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/mustfail/campaign_helper.hpp"
#include "tests/testbench/cycle_board_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

cmodel::Config post() { return named_config(std::string("faults/") + testbench::kBreakablePost); }

TEST(Interpolated, EachEventHappensInItsCycle) {
  const cmodel::Config config = post();
  Random random(seed_or(93));
  CycleComparison total;
  std::uint64_t seed = 0;
  for (const std::string& input : Pattern::examples()) {
    for (const std::string& output : Pattern::examples()) {
      ++seed;
      const auto beats = to_beats(random_stream(symbols_of(config), random, 60).bytes);
      const auto one = compare_cycles(config, beats, Pattern(input, seed), Pattern(output, seed + 1000),
                                      faulty(Fault::None, Assertions::On));
      total += one;
      ASSERT_EQ(one.mismatches, 0U) << input << "/" << output << ": " << one.first;
    }
  }
  judge("interpolated, random", total);
}

TEST(Interpolated, RandomStreamsOfEveryClass) {
  testbench::CampaignOptions options{.verify = {.config = post(), .ready = "all", .wave = {}, .device = {}},
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
    std::printf("[figure] interpolated, input %s: comparisons = %llu (limit > 100000), mismatches = %llu (limit 0)\n",
                input, static_cast<unsigned long long>(result.total.check.comparisons),
                static_cast<unsigned long long>(result.total.check.mismatches));
    EXPECT_GT(result.total.check.comparisons, 100000U);
    EXPECT_EQ(result.total.check.mismatches, 0U);
  }
}

}  // namespace
}  // namespace fastsplat::test
