// SPDX-License-Identifier: Apache-2.0
// Functional coverage: the hits of a small known stream, no cost when off, and random campaigns reach their bins.
#include "testbench/coverage/coverage.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "driver/config/config_file.hpp"
#include "testbench/coverage/coverage_collector.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "tests/testbench/directed_helper.hpp"

namespace fastsplat::testbench {
namespace {

VerifyOptions sampled(const char* config) {
  VerifyOptions options;
  options.config = driver::load_config(config);
  options.coverage = true;
  return options;
}

/// Tables and one full tile with one sheet per list of centres, in pixels.
StreamDocument centres(const cmodel::Config& config, const std::vector<std::vector<int>>& sheets) {
  auto document = make_stimulus(config, StimulusClass::Thresholds, 1, 1).document;
  const auto rlut = document.tables.front();
  document.tiles.resize(1);
  auto& tile = document.tiles.front();
  tile.begin = {.mode = cmodel::Mode::Additive,
                .tile = 0,
                .x = 0,
                .y = 0,
                .width = config.tile_width,
                .height = config.tile_height};
  tile.sheets.clear();
  const std::int32_t pixel = 1 << config.position_frac_bits;
  for (const auto& places : sheets) {
    SheetDocument sheet{static_cast<std::uint32_t>(tile.sheets.size()), {}};
    for (const int place : places)
      sheet.records.emplace_back(cmodel::SplatRecord{
          .set = rlut.radius.set, .tag = 0, .x = place * pixel, .y = 5 * pixel, .colour = {1, 1, 1, 1}});
    tile.sheets.push_back(std::move(sheet));
  }
  return document;
}

Coverage coverage_of(const StreamDocument& document, const VerifyOptions& options) {
  const auto result = verify(source_of(write_document(options.config, document)), options);
  EXPECT_EQ(result.verdict, Verdict::Pass) << result.error;
  return result.coverage ? *result.coverage : Coverage();
}

TEST(Coverage, IsFreeWhenOff) {
  VerifyOptions options = sampled("tiny");
  options.coverage = false;
  const auto beats = write_document(options.config, centres(options.config, {{5, 5}}));
  EXPECT_EQ(verify(source_of(beats), options).coverage, nullptr);
}

TEST(Coverage, OfHazardsIsThatOfTheHand) {
  const auto options = sampled("tiny");
  // The same place twice, then again over one window elsewhere; then across a swap: end_sheet, begin_sheet, window.
  const Coverage coverage = coverage_of(centres(options.config, {{5, 5, 20, 5}, {5}}), options);
  EXPECT_EQ(coverage.hits("hazard.distance_1"), 1u);
  EXPECT_EQ(coverage.hits("hazard.distance_2"), 1u);
  EXPECT_EQ(coverage.hits("hazard.distance_3"), 0u);
  EXPECT_EQ(coverage.hits("hazard.whole_window_1"), 1u);
  EXPECT_EQ(coverage.hits("hazard.across_swap_3"), 1u);
  EXPECT_EQ(coverage.hits("swap.sheet_of_windows_04"), 1u);
  EXPECT_EQ(coverage.hits("swap.sheet_of_windows_01"), 1u);
  EXPECT_EQ(coverage.hits("record.splat"), 5u);
  EXPECT_EQ(coverage.hits("tile.additive"), 1u);
  EXPECT_EQ(coverage.hits("tile.sum"), 0u);
  EXPECT_EQ(coverage.hits("counter.splats"), 5u);
  EXPECT_EQ(coverage.hits("output.tile_never_held"), 1u);
  EXPECT_EQ(coverage.hits("output.first_beat_held"), 0u);
}

TEST(Coverage, OfASheetLongerThanItsWalkSaysSo) {
  const auto options = sampled("tiny");
  const Coverage coverage = coverage_of(centres(options.config, {{5}, std::vector<int>(30, 9)}), options);
  EXPECT_EQ(coverage.hits("swap.walk_begins_at_window_10"), 1u);
  EXPECT_EQ(coverage.hits("swap.walk_begins_after_the_sheet"), 0u);
}

TEST(Coverage, BinsHitInAFailingRunDoNotCount) {
  VerifyOptions options = sampled("tiny");
  options.timeout = 1;  // the device wipes its memories for longer
  const auto result = verify(source_of(write_document(options.config, centres(options.config, {{5}}))), options);
  EXPECT_EQ(result.verdict, Verdict::Simulation);
  EXPECT_EQ(result.coverage, nullptr);
}

TEST(Coverage, MergesAndAddsUp) {
  Coverage a, b;
  a.hit(a.declare("g", "x"), 2);
  b.hit(b.declare("g", "y"), 3);
  b.hit(b.declare("g", "x"), 5);
  a.merge(b);
  EXPECT_EQ(a.hits("g.x"), 7u);
  EXPECT_EQ(a.hits("g.y"), 3u);
  EXPECT_EQ(a.hits("g.z"), 0u);
  EXPECT_EQ(a.bins().size(), 2u);
}

TEST(Coverage, RoundingDistinguishesExactTieAndSides) {
  Coverage coverage;
  const cmodel::Format format{0, 20, 0, 0};
  const RoundingPoint point(coverage, "g", "p_", {cmodel::Rounding::RND, cmodel::Overflow::SAT, 2, format}, 100);
  for (const std::int64_t value : {4, 5, 6, 7, 82, 81}) point.sample(coverage, value);
  EXPECT_EQ(coverage.hits("g.p_exact"), 1u);
  EXPECT_EQ(coverage.hits("g.p_below"), 2u);
  EXPECT_EQ(coverage.hits("g.p_tie"), 2u);
  EXPECT_EQ(coverage.hits("g.p_above"), 1u);
  EXPECT_EQ(coverage.hits("g.p_saturated"), 1u) << "82/4 rounds up to 21";
  const RoundingPoint none(coverage, "h", "", {cmodel::Rounding::RND, cmodel::Overflow::SAT, 0, format}, 20);
  EXPECT_FALSE(coverage.declared("h.tie"));
  EXPECT_FALSE(coverage.declared("h.saturated"));
}

TEST(Campaign, EveryClassMeetsEveryPatternOverSixSeeds) {
  const std::vector<StimulusClass> one{StimulusClass::Hazards}, all = stimulus_classes();
  const std::vector<StimulusClass> most(all.begin(), all.end() - 1);
  // With any number of alternating classes.
  for (const auto& classes : {one, most, all}) {
    CampaignOptions campaign;
    campaign.verify = sampled("tiny");
    campaign.verify.ready = "all";
    campaign.seeds = Pattern::examples().size();
    campaign.splats = classes.size();
    campaign.classes = classes;
    const auto result = run_campaign(campaign);
    ASSERT_EQ(result.total.verdict, Verdict::Pass);
    std::map<std::pair<StimulusClass, std::string>, int> crossings;
    for (const auto& stream : result.by_stream) ++crossings[{stream.which, stream.ready}];
    std::size_t crossed = 0;
    for (const auto& [pair, streams] : crossings) {
      // The sink of BackPressure never takes at once: it replaces `always` with its own pattern.
      if (pair.first == StimulusClass::BackPressure) continue;
      EXPECT_EQ(streams, 1) << to_string(pair.first) << " " << pair.second;
      ++crossed;
    }
    const bool pauses = std::ranges::find(classes, StimulusClass::BackPressure) != classes.end();
    std::printf("[figure] class x ready pattern = %zu of %zu classes x %zu patterns\n", crossed, classes.size(),
                Pattern::examples().size());
    EXPECT_EQ(crossed, (classes.size() - (pauses ? 1 : 0)) * Pattern::examples().size());
  }
}

class Directed : public ::testing::TestWithParam<const char*> {};

// Every register, answer and counter of the device as a whole:
// - the identity, and unknown addresses (M-register-3, M-register-5); answers that wait (M-register-1, M-register-2);
// - answers beside a frame that is under way (M-register-4), and gone after a reset (M-reset-3);
// - zeros after a reset (M-register-10), and the high word before any low one (M-register-9);
// - when an event is in a counter (M-register-12), and what a clear forgets (M-register-13);
// - STATUS before, in and after a frame, without input too (M-register-14);
// - the counters by number (M-register-15), and none beyond them (M-register-16, M-register-17).
TEST_P(Directed, RegistersAnswerAsThePageSays) {
  const auto config = driver::load_config(GetParam());
  expect_all(check_registers(config, rtl_of(config)));
}

/// The tables of base are long; it is in broken_streams_slow_test.cpp.
class DirectedRefusals : public ::testing::TestWithParam<const char*> {};

// S-reader-4, S-rule-1, S-rule-2. A frame without its tiles is legal (S-file-7).
// The beat is checked in its cycle (M-check-4, M-check-5) and reported (M-check-6). Later beats change no counter
// (M-check-7). An open tile is ended in the model's cycles (M-check-8) and marked (M-check-9). A soft reset ends a
// frame anywhere (M-check-10), clears the error (M-check-11) and keeps counters and IRQ_MASK (M-check-12).
// IRQ and its mask (M-register-5, M-register-7) and the interrupt (M-port-11); STATUS while a beat is in check
// (M-register-14, M-top-4); frames behind each other, whose counters go on (M-register-18), and that need their own
// tables (M-register-10). IRQ before and after the sink has taken the last pixels (M-top-5, M-port-12); beats that are
// dropped before a begin_frame (M-top-6) and by CONTROL (M-top-7), at once (M-top-8); verdicts in the model's cycles
// (M-top-3).
TEST_P(DirectedRefusals, StreamsThatBreakARuleAreRefusedAsTheModelRefusesThem) {
  const auto config = driver::load_config(GetParam());
  const auto result = check_refusals(config, rtl_of(config));
  expect_all(result);
  EXPECT_GT(refused_streams(result), 0);
}

TEST_P(DirectedRefusals, DamagedStreamsMeetTheModelsVerdict) {
  const auto config = driver::load_config(GetParam());
  const auto result = check_damage(config, rtl_of(config), 1, 200);
  expect_all(result);
  EXPECT_GT(refused_streams(result), 0);
}

/// Configurations do not differ in what a reset clears; the largest takes seconds.
class DirectedResets : public ::testing::TestWithParam<const char*> {};

// One clock edge, in the middle of any work, clears all of it (M-reset-1, M-reset-2).
TEST_P(DirectedResets, OfOneCycleForgetAnyRecord) {
  const auto config = driver::load_config(GetParam());
  expect_all(check_short_resets(config, rtl_of(config)));
}

constexpr auto kConfigName = [](const auto& param) { return std::string(param.param); };
INSTANTIATE_TEST_SUITE_P(Configurations, Directed, ::testing::Values("tiny", "small", "base"), kConfigName);
INSTANTIATE_TEST_SUITE_P(Configurations, DirectedRefusals, ::testing::Values("tiny", "small"), kConfigName);
INSTANTIATE_TEST_SUITE_P(Configurations, DirectedResets, ::testing::Values("tiny", "small"), kConfigName);

}  // namespace
}  // namespace fastsplat::testbench
