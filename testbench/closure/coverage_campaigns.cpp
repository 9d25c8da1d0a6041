// SPDX-License-Identifier: Apache-2.0
#include "testbench/closure/coverage_campaigns.hpp"

#include "testbench/coverage/coverage_collector.hpp"
#include "testbench/stimulus/left_out.hpp"

namespace fastsplat::testbench {
namespace {

std::string what_failed(const std::string& campaign, const VerifyResult& result) {
  std::string text = campaign + ": " + to_string(result.verdict);
  if (!result.error.empty()) text += ": " + result.error;
  if (!result.check.differences.empty()) text += ": " + result.check.differences.front();
  return text;
}

/// Enough for hidden cull groups before, between and after visible ones.
constexpr std::uint64_t kLeftOutSplats = 150, kLeftOutStreams = 24;

class Runner {
 public:
  explicit Runner(const CoverageOrder& order) : order_(order) { runs_.book = CoverageBook::of(order.config); }

  CoverageRuns take() { return std::move(runs_); }

  VerifyOptions options() const {
    VerifyOptions options;
    options.config = order_.config;
    options.coverage = true;
    options.device = order_.device;
    return options;
  }

  void classes() {
    begin("stimulus classes");
    CampaignOptions campaign{.verify = options(),
                             .splats = order_.volume.splats,
                             .seeds = order_.volume.seeds,
                             .classes = order_.classes,
                             .threads = order_.threads,
                             .progress = {}};
    campaign.verify.ready = campaign.verify.input = "all";
    const auto result = add(run_campaign(campaign), "stimulus classes");
    for (const auto& [which, coverage] : result.coverage) runs_.book.campaigns[to_string(which)].merge(coverage);
  }

  /// Warm resets with each fill of the memories, and streams from power-up with each.
  void resets() {
    begin("resets");
    Coverage& coverage = runs_.book.campaigns["resets"];
    for (const ResetFill fill : {ResetFill::Zero, ResetFill::One, ResetFill::Random}) {
      CampaignOptions campaign{.verify = options(),
                               .splats = 60,
                               .seeds = order_.volume.resets / 3 + 1,
                               .classes = {StimulusClass::Reset},
                               .threads = order_.threads,
                               .progress = {}};
      campaign.verify.seed = 1000 * (static_cast<std::uint64_t>(fill) + 1);
      campaign.verify.fill = fill;
      // Some resets come later, while the work of the last beats continues.
      campaign.verify.reset_wait = fill == ResetFill::Zero ? 0 : fill == ResetFill::One ? 12 : 24;
      const auto result = add(run_campaign(campaign), std::string("resets, memories filled with ") + to_string(fill));
      for (const auto& [which, part] : result.coverage) coverage.merge(part);
    }
  }

  /// For devices that cull: random streams from a source that leaves out hidden splats.
  void left_out() {
    if (!order_.config.culls()) return;
    begin("left out");
    CampaignOptions campaign{.verify = options(),
                             .splats = kLeftOutSplats,
                             .seeds = kLeftOutStreams,
                             .classes = {StimulusClass::Mixed},
                             .threads = 1,
                             .progress = {}};
    campaign.verify.ready = campaign.verify.input = "all";
    Coverage& coverage = runs_.book.campaigns["left out"];
    for (std::size_t i = 0; i < run_count(campaign); ++i) {
      CampaignRun run = make_run(campaign, i);
      run.options.scope = cmodel::StreamScope::Subset;
      CampaignResult result;
      result.total = verify(source_of(without_hidden_sets(order_.config, run.beats)), run.options);
      result.streams = 1;
      add(result, "left out");
      if (result.total.coverage) coverage.merge(*result.total.coverage);
    }
  }

  void scenes() {
    for (const auto& [name, source] : order_.scenes) {
      begin("scene " + name);
      VerifyOptions run = options();
      run.scope = cmodel::StreamScope::Subset;
      CampaignResult result;
      result.total = verify(source, run);
      result.streams = 1;
      add(result, "scene " + name);
      if (result.total.coverage) runs_.book.campaigns["scene"].merge(*result.total.coverage);
    }
  }

  void directed() {
    const MakeDevice make =
        order_.device ? order_.device : [this](cmodel::PixelSink& pixels, const RtlOptions& options) {
          return make_rtl_device(order_.config, pixels, options);
        };
    begin("registers and refusals");
    for (const auto& [name, check] : {std::pair{"registers", &check_registers}, std::pair{"refusals", &check_refusals},
                                      std::pair{"short resets", &check_short_resets}}) {
      const DirectedResult result = check(order_.config, make);
      for (const auto& failure : result.failures) runs_.failures.push_back(std::string(name) + ": " + failure);
      runs_.book.comparisons += result.comparisons;
      runs_.book.campaigns[name].merge(result.coverage);
    }
  }

 private:
  void begin(const std::string& campaign) const {
    if (order_.progress) order_.progress(order_.config.name + ", " + campaign);
  }

  const CampaignResult& add(const CampaignResult& result, const std::string& name) {
    runs_.book.streams += result.streams;
    runs_.book.splats += result.total.counters.splats;
    runs_.book.comparisons += result.total.check.comparisons;
    runs_.book.cycles += result.total.check.cycles_rtl.value_or(0);
    if (result.total.verdict != Verdict::Pass) runs_.failures.push_back(what_failed(name, result.total));
    return result;
  }

  const CoverageOrder& order_;
  CoverageRuns runs_;
};

}  // namespace

Coverage planned_bins(const cmodel::Config& config) {
  Coverage bins = CoverageCollector::declare(config);
  bins.merge(directed_bins());
  return bins;
}

CoverageRuns run_coverage(const CoverageOrder& order) {
  Runner runner(order);
  runner.classes();
  runner.resets();
  runner.left_out();
  runner.scenes();
  runner.directed();
  return runner.take();
}

}  // namespace fastsplat::testbench
