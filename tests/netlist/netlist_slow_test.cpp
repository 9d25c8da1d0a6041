// SPDX-License-Identifier: Apache-2.0
// The synthesised device under the project's own checker: every tap, pixel, counter and cycle is the model's.
#include <gtest/gtest.h>

#include <cstdio>

#include "driver/config/config_file.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "testbench/triage/failure.hpp"
#include "tests/netlist/netlist_helper.hpp"

namespace fastsplat::test {
namespace {

using namespace testbench;

/// Also into the report of --gtest_output, which docs/evidence.md is made from.
void figure(const std::string& name, std::uint64_t value, const char* limit) {
  std::printf("[figure] %s %s = %llu (limit %s)\n", FASTSPLAT_NETLIST_NAME, name.c_str(),
              static_cast<unsigned long long>(value), limit);
  ::testing::Test::RecordProperty(name, std::to_string(value));
}

CampaignOptions campaign(std::uint64_t splats) {
  CampaignOptions to;
  to.verify.config = driver::load_config(FASTSPLAT_NETLIST_CONFIG);
  to.verify.device = [config = to.verify.config](cmodel::PixelSink& pixels, const RtlOptions& options) {
    return make_netlist(config, pixels, options);
  };
  to.verify.ready = "all";
  to.splats = splats;
  to.threads = 2;
  return to;
}

TEST(Netlist, RandomStreamsEqualTheModelUnderEveryPattern) {
  CampaignOptions options = campaign(FASTSPLAT_NETLIST_SPLATS);
  options.seeds = Pattern::examples().size();  // so every class meets every pattern
  const auto result = run_campaign(options);
  EXPECT_EQ(result.total.verdict, Verdict::Pass)
      << (result.failure ? first_divergence(*result.failure, options.verify.config) : "");
  figure("splats", result.total.counters.splats, "> 0");
  figure("comparisons", result.total.check.comparisons, "> 0");
  figure("mismatches", result.total.check.mismatches, "0");
  figure("cycles", result.total.check.cycles_rtl.value_or(0), "> 0");
  EXPECT_EQ(result.total.check.mismatches, 0U);
  EXPECT_GT(result.total.check.comparisons, 0U);
  EXPECT_GT(result.total.check.cycles_rtl.value_or(0), 0U);
  EXPECT_EQ(result.total.check.cycles_rtl, result.total.check.cycles_model);
  for (const auto count : result.total.check.by_tap) EXPECT_GT(count, 0U);
}

TEST(Netlist, FillsAndResetsChangeNothing) {
  std::uint64_t comparisons = 0;
  for (const ResetFill fill : {ResetFill::Zero, ResetFill::One, ResetFill::Random}) {
    for (const std::uint64_t reset_after : {0U, 3U, 60U}) {
      CampaignOptions options = campaign(FASTSPLAT_NETLIST_SPLATS / 8);
      options.classes = {StimulusClass::Mixed, StimulusClass::Hazards};
      options.verify.fill = fill;
      options.verify.reset_after = reset_after;
      const auto result = run_campaign(options);
      EXPECT_EQ(result.total.verdict, Verdict::Pass) << to_string(fill) << ", reset after " << reset_after;
      EXPECT_EQ(result.total.check.mismatches, 0U);
      comparisons += result.total.check.comparisons;
    }
  }
  figure("comparisons", comparisons, "> 0");
  EXPECT_GT(comparisons, 0U);
}

TEST(Netlist, ANetTiedToZeroIsSeenAndShrunk) {
  CampaignOptions options = campaign(2000);
  options.classes = {StimulusClass::Hazards};
  options.verify.device = [config = options.verify.config](cmodel::PixelSink& pixels, const RtlOptions& rtl) {
    return make_cut_netlist(config, pixels, rtl);
  };
  cmodel::NullPixels none;
  if (!make_cut_netlist(options.verify.config, none, {})) GTEST_SKIP() << "no broken netlist of this kind is built";
  const auto result = run_campaign(options);
  ASSERT_TRUE(result.failure.has_value()) << "SURVIVED";
  EXPECT_EQ(result.failure->verdict, Verdict::Mismatch);
  EXPECT_EQ(result.failure->check.detector, Detector::Sheet);
  const CampaignRun run = make_run(options, *result.failed);
  const FailureReport report = investigate(source_of(run.beats), run.options, *result.failure, {}, 200);
  std::printf("%s\n%s\n%s\n", report.original.c_str(), report.divergence.c_str(), report.operands.c_str());
  figure("mismatches_of_the_cut", result.failure->check.mismatches, "> 0");
  figure("splats_of_the_smallest_stream", report.shrink.splats_after, "<= 3");
  EXPECT_LE(report.shrink.splats_after, 3U);
}

}  // namespace
}  // namespace fastsplat::test
