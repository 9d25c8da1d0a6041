// SPDX-License-Identifier: Apache-2.0
// The device that interpolates its radial table and classifies densities by pixel, whole and with its assertions on:
// every event in the cycle model's cycle, every word the model's. It is the device of the must-fail suite without a
// selected fault.
#include <gtest/gtest.h>

#include <cstdio>

#include "testbench/check/verify.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/mustfail/campaign_helper.hpp"
#include "tests/testbench/cycle_board_helper.hpp"
#include "tests/testbench/directed_helper.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

cmodel::Config post() { return named_config(std::string("faults/") + testbench::kBreakablePost); }

// Copies, walks and the pixel stage of a device with ellipses, interpolation and two slices a block, beside tiles of
// other modes (M-density-1, M-density-2). A tap of another block or cycle, a buffer or an end_tile that waits another
// time is a mismatch:
// - places: windows and blocks by the halo (M-density-3, M-density-4);
// - copies of a cycle a block (M-density-6), walks of D (M-density-10), reads and slices (M-density-11, M-density-12);
// - end_tile's turn (M-density-13), the formulas (M-density-14, M-density-15), rest (M-density-16, M-density-18);
// - the sheet of each composite tap (M-density-17).
TEST(PostClassified, EachEventHappensInItsCycle) {
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
      // Two registers more behind c5 (M-weights-1), on top of an ellipse's 10 (M-ellipse-1); two slices (M-slices-1).
      ASSERT_EQ(one.mismatches, 0U) << input << "/" << output << ": " << one.first;
    }
  }
  judge("post-classified, random", total);
}

// Every word of every tap and pixel, and every counter:
// - by banks of the halo (M-density-4), and what tiles behind it find in the picture (M-density-5);
// - of the ring's parts, those of older sheets and tiles being empty (M-density-7, M-density-8, M-density-9);
// - with the words of SHEETS of each sheet (M-density-20);
// - what is composited is counted (M-density-22).
TEST(PostClassified, RandomStreamsOfEveryClass) {
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
    std::printf(
        "[figure] post-classified, input %s: comparisons = %llu (limit > 100000), mismatches = %llu (limit 0)\n", input,
        static_cast<unsigned long long>(result.total.check.comparisons),
        static_cast<unsigned long long>(result.total.check.mismatches));
    EXPECT_GT(result.total.check.comparisons, 100000U);
    // Weights of any table (M-weights-2); sums of two slices (M-slices-2).
    EXPECT_EQ(result.total.check.mismatches, 0U);
  }
}

testbench::MakeDevice whole() {
  return [config = post()](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
    return faulty(Fault::None, Assertions::On)(config, pixels, rtl);
  };
}

// Frames as the driver sends them: adjacent tiles, missing sheets (M-density-9), perspective.
TEST(PostClassified, FramesEqualTheModel) {
  for (const bool perspective : {false, true}) {
    scene::SceneDescription description;
    description.volume = "shells:12";
    description.transfer_function = "ct-head";
    description.width = description.height = 40;
    description.camera.azimuth = 31;
    description.camera.elevation = 20;
    description.classify = scene::ClassifyOrder::Post;
    if (perspective) description.camera.projection = scene::Projection::Perspective;
    const auto beats = scene_beats(description, post());
    testbench::VerifyOptions options;
    options.config = post();
    options.scope = cmodel::StreamScope::Subset;
    options.ready = "random-50";
    options.input = "burst-16";
    options.device = whole();
    const auto result = testbench::verify(testbench::source_of(beats), options);
    std::printf(
        "[figure] densities%s: comparisons = %llu (limit > 100000), mismatches = %llu (limit 0), dirty blocks = %llu\n",
        perspective ? ", perspective" : "", static_cast<unsigned long long>(result.check.comparisons),
        static_cast<unsigned long long>(result.check.mismatches),
        static_cast<unsigned long long>(result.counters.dirty_blocks));
    EXPECT_EQ(result.verdict, testbench::Verdict::Pass) << result.error;
    EXPECT_GT(result.check.comparisons, 100000U);
  }
}

// Tables of densities and their words (N-6.2-6, S-table-11, S-table-12), tiles (N-6.2-3, S-tile-1, S-tile-3) and sheets
// (S-tile-7) just outside the legal range: refused by the model's rule. Density tiles that are cut short end in the
// cycle model's cycles (M-density-13, M-density-18).
TEST(PostClassified, RefusesTheSameStreamsAsTheModel) {
  const auto result = testbench::check_refusals(post(), whole());
  testbench::expect_all(result);
  const int refused = testbench::refused_streams(result);
  std::printf(
      "[figure] post-classified: streams that break a rule, refused as the model refuses them = %d (limit >= 250)\n",
      refused);
  EXPECT_GE(refused, 250);
}

TEST(PostClassified, DamagedStreamsMeetTheModelsVerdict) {
  constexpr int kStreams = 300;
  const auto result = testbench::check_damage(post(), whole(), 2, kStreams);
  testbench::expect_all(result);
  const int refused = testbench::refused_streams(result);
  std::printf(
      "[figure] post-classified: damaged streams = %d, refused as the model refuses them = %d, comparisons = %llu\n",
      kStreams, refused, static_cast<unsigned long long>(result.comparisons));
  EXPECT_GT(refused, kStreams / 2);
  EXPECT_LT(refused, kStreams);
}

}  // namespace
}  // namespace fastsplat::test
