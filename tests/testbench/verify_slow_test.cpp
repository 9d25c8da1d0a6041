// SPDX-License-Identifier: Apache-2.0
// Whole frames and random streams through the RTL of every configuration, beside the model.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "driver/config/config_file.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::testbench {
namespace {

class Rtl : public ::testing::TestWithParam<const char*> {
 protected:
  VerifyOptions options() const {
    VerifyOptions to;
    to.config = driver::load_config(GetParam());
    return to;
  }
};

struct Pixels final : cmodel::PixelSink {
  std::vector<std::uint32_t> words;
  void on_tile(cmodel::TilePixels&& tile) override { words.insert(words.end(), tile.words.begin(), tile.words.end()); }
};

// Every word of every tap at its bits (M-port-2, M-tap-2, M-tap-3, M-tap-5) and of every pixel (M-port-5), of devices
// of three widths; a verdict of them would be a mismatch (M-port-9).
TEST_P(Rtl, WholeFramesEqualTheModelOnEveryTap) {
  struct Frame {
    scene::Method method;
    double slab_width;
  };
  std::uint64_t comparisons = 0;
  for (const Frame frame : {Frame{scene::Method::ImageAligned, 0.5}, Frame{scene::Method::ImageAligned, 1.0},
                            Frame{scene::Method::ImageAligned, 2.0}, Frame{scene::Method::AxisAligned, 1.0},
                            Frame{scene::Method::XRay, 1.0}}) {
    scene::SceneDescription description;
    description.volume = "shells:16";
    description.width = 72;  // more than a tile of tiny and small, and no multiple of one
    description.height = 40;
    description.method = frame.method;
    description.slab_width = frame.slab_width;
    VerifyOptions run = options();
    run.scope = cmodel::StreamScope::Subset;
    const auto result = verify(source_of(test::scene_beats(description, run.config)), run);
    EXPECT_EQ(result.verdict, Verdict::Pass) << scene::to_string(frame.method) << " slab " << frame.slab_width;
    EXPECT_EQ(result.check.mismatches, 0u);
    for (const auto count : result.check.by_tap) EXPECT_GT(count, 0u);
    comparisons += result.check.comparisons;
  }
  std::printf("[figure] %s frame comparisons = %llu\n", GetParam(), static_cast<unsigned long long>(comparisons));
}

TEST_P(Rtl, RandomStreamsEqualTheModelUnderEveryReadyPattern) {
  CampaignOptions campaign;
  campaign.verify = options();
  campaign.verify.ready = "all";
  campaign.splats = 1700;
  campaign.seeds = Pattern::examples().size();  // so every class meets every pattern
  campaign.threads = 2;
  const auto result = run_campaign(campaign);
  EXPECT_EQ(result.total.verdict, Verdict::Pass) << (result.failed ? *result.failed : 0);
  EXPECT_EQ(result.total.counters.splats, campaign.splats * campaign.seeds);
  std::printf("[figure] %s random splats = %llu, comparisons = %llu, cycles = %llu\n", GetParam(),
              static_cast<unsigned long long>(result.total.counters.splats),
              static_cast<unsigned long long>(result.total.check.comparisons),
              static_cast<unsigned long long>(result.total.check.cycles_rtl.value_or(0)));
}

// Power-up with any words equals a reset in the middle of work (M-reset-1): memories are wiped (M-reset-4).
TEST_P(Rtl, ResetFillsAndPatternsNeverChangeAPixel) {
  const auto config = options().config;
  const auto source = source_of(write_document(config, make_stimulus(config, StimulusClass::Mixed, 9, 300).document));
  Pixels first;
  ASSERT_EQ(verify(source, options(), &first).verdict, Verdict::Pass);
  ASSERT_FALSE(first.words.empty());
  const auto same = [&](const VerifyOptions& run) {
    Pixels pixels;
    EXPECT_EQ(verify(source, run, &pixels).verdict, Verdict::Pass);
    return pixels.words == first.words;
  };
  for (const ResetFill fill : {ResetFill::Zero, ResetFill::One, ResetFill::Random}) {
    VerifyOptions run = options();
    run.fill = fill;
    EXPECT_TRUE(same(run)) << to_string(fill);
  }
  for (const auto& pattern : Pattern::examples()) {
    VerifyOptions run = options();
    run.ready = run.input = pattern;
    EXPECT_TRUE(same(run)) << pattern;
  }
  for (const std::uint64_t beats : {1u, 50u, 300u}) {
    VerifyOptions run = options();
    run.reset_after = beats;
    EXPECT_TRUE(same(run)) << "reset after " << beats;
  }
}

INSTANTIATE_TEST_SUITE_P(Configurations, Rtl, ::testing::Values("tiny", "small", "base"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace fastsplat::testbench
