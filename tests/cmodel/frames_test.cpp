// SPDX-License-Identifier: Apache-2.0
// Whole random frames: every tap, pixel and counter of the model against the oracle, on every named configuration and
// on random legal ones.
#include <gtest/gtest.h>

#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"

namespace fastsplat::test {
namespace {

class NamedFrames : public ::testing::TestWithParam<std::string> {};

TEST_P(NamedFrames, ModelEqualsOracle) {
  const cmodel::Config config = named_config(GetParam());
  ASSERT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
  Random random(seed_or(1));
  const Campaign result = compare_streams(config, random, 10000, 400);
  print(GetParam().c_str(), result.comparison);
  if (config.has_ellipses()) {
    print_ellipses(GetParam().c_str(), result);
    EXPECT_GT(result.ellipses.weighted, 10000U) << "no ellipses were compared";
  }
  RecordProperty("splats", static_cast<int>(result.splats));
  EXPECT_EQ(result.comparison.mismatches, 0U) << result.comparison.first;
  for (const char* what : {"snap", "footprint", "sheet", "composite", "pixel", "picture", "counter"})
    EXPECT_GT(result.comparison.compared.count(what), 0U) << what << ": nothing was compared";
}

INSTANTIATE_TEST_SUITE_P(Configs, NamedFrames, ::testing::ValuesIn(config_names()),
                         [](const auto& param_info) { return param_info.param; });

TEST(RandomFrames, ModelEqualsOracleOnRandomConfigurations) {
  Random random(seed_or(2));
  Campaign total;
  int configs = 0;
  for (; configs < 100 && total.comparison.mismatches == 0; ++configs) {
    const cmodel::Config config = random_config(random);
    const Campaign result = compare_streams(config, random, 300, 300);
    total.comparison += result.comparison;
    total.splats += result.splats;
  }
  print("random configurations", total.comparison);
  std::printf("[figure] random configurations = %d, splats = %llu\n", configs,
              static_cast<unsigned long long>(total.splats));
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_GT(total.comparison.total(), 0U) << "nothing was compared";
}

// The comparison must notice: one LSB, one missing event, one wrong place, one wrong count.
TEST(Comparison, ReportsEveryPerturbation) {
  const cmodel::Config config = named_config("tiny");
  Random random(seed_or(3));
  const RandomStream stream = random_stream(symbols_of(config), random, 200);
  const oracle::Rendering expected = oracle::render(symbols_of(config), stream.bytes);
  ASSERT_EQ(compare(expected, expected).mismatches, 0U);

  std::uint64_t seen = 0;
  const auto must_fail = [&](const oracle::Rendering& wrong, const char* what) {
    const Comparison comparison = compare(wrong, expected);
    EXPECT_EQ(comparison.mismatches, 1U) << what << ": " << comparison.first;
    EXPECT_FALSE(comparison.first.empty()) << what;
    seen += comparison.mismatches;
  };
  for (const oracle::Kind kind : {oracle::Kind::Snap, oracle::Kind::Footprint, oracle::Kind::Sheet,
                                  oracle::Kind::Composite, oracle::Kind::Pixel}) {
    oracle::Rendering wrong = expected;
    auto last = wrong.events.rbegin();
    while (last != wrong.events.rend() && last->kind != kind) ++last;
    ASSERT_NE(last, wrong.events.rend()) << "the stream has no such event";
    last->payload.back() ^= 1;
    must_fail(wrong, "one LSB of a tap");
    last->payload.back() ^= 1;
    last->x += 1;
    must_fail(wrong, "the place of a tap");
    last->x -= 1;
    last->tag += 1;
    must_fail(wrong, "the tag of a tap");
  }
  oracle::Rendering wrong = expected;
  wrong.tiles.back().words.back() ^= 1;
  must_fail(wrong, "one LSB of a pixel");
  wrong = expected;
  wrong.tiles.pop_back();
  must_fail(wrong, "a missing tile");
  wrong = expected;
  wrong.events.pop_back();
  must_fail(wrong, "a missing event");
  wrong = expected;
  wrong.counts["windows"] += 1;
  must_fail(wrong, "a counter off by one");
  std::printf("[figure] perturbations seen = %llu (limit 19)\n", static_cast<unsigned long long>(seen));
  EXPECT_EQ(seen, 19U);
}

}  // namespace
}  // namespace fastsplat::test
