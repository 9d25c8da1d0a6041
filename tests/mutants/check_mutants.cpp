// SPDX-License-Identifier: Apache-2.0
// check_mutants CONFIG.toml: the checks of a whole device (serve_mutants.hpp).
#include "tests/mutants/check_mutants.hpp"

#include <span>
#include <utility>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "testbench/stimulus/directed.hpp"
#include "testbench/stimulus/left_out.hpp"
#include "tests/mustfail/campaign_helper.hpp"
#include "tests/mutants/serve_mutants.hpp"

namespace fastsplat::test {
namespace {

using testbench::StimulusClass;

/// Longer than any wait of a healthy device in these streams.
constexpr std::uint64_t kTimeout = 40000;

testbench::MakeDevice mutant_of(const cmodel::Config& config) {
  return [config](cmodel::PixelSink& pixels, testbench::RtlOptions options) {
    options.timeout = kTimeout;
    return make_mutant(config, pixels, options);
  };
}

/// Streams of some classes; made once, for they are the same for each mutant.
Named streams(const std::string& name, const cmodel::Config& config, std::vector<StimulusClass> classes,
              std::uint64_t splats, std::uint64_t seeds, const std::string& input = "all", bool left_out = false) {
  testbench::CampaignOptions options;
  options.verify.config = config;
  options.verify.ready = "all";
  options.verify.input = input;
  options.verify.timeout = kTimeout;
  options.verify.stop_after = 1;
  options.verify.device = mutant_of(config);
  options.splats = splats * classes.size();
  options.seeds = seeds;
  options.classes = std::move(classes);
  std::vector<testbench::CampaignRun> runs;
  for (std::size_t i = 0; i < run_count(options); ++i) runs.push_back(make_run(options, i));
  for (auto& run : std::span(runs).first(left_out ? runs.size() : 0)) {
    run.beats = testbench::without_hidden_sets(config, run.beats);
    run.options.scope = cmodel::StreamScope::Subset;
  }
  return {name, [runs = std::move(runs)] {
            Said said;
            for (const auto& run : runs) {
              const auto result = verify(testbench::source_of(run.beats), run.options);
              said.comparisons += result.check.comparisons;
              if (result.verdict == testbench::Verdict::Pass) continue;
              said.text = !result.error.empty()   ? result.error
                          : result.check.detector ? to_string(*result.check.detector)
                                                  : to_string(result.verdict);
              break;
            }
            return said;
          }};
}

template <class Check>
Named directed(const std::string& name, const cmodel::Config& config, Check check) {
  return {name, [=] {
            const auto result = check(config, mutant_of(config));
            return Said{result.failures.empty() ? "" : result.failures.front(), result.comparisons};
          }};
}

/// The stimuli of tests/mustfail, made to show what other streams may not.
Named must_fail(const cmodel::Config& config) {
  return {"mustfail", [=] {
            Said said;
            for (const Stimulus stimulus : kStimuli) {
              const Outcome outcome = run(config, stimulus, [](const auto& c, auto& pixels, const auto& options) {
                return make_mutant(c, pixels, options);
              });
              said.comparisons += outcome.comparisons;
              if (!outcome.caught) continue;
              said.text = std::string(to_string(stimulus)) + ": " + to_string(outcome.caught->by);
              break;
            }
            return said;
          }};
}

std::vector<Named> checks_of(const cmodel::Config& config) {
  std::vector<Named> checks{streams("random", config, {StimulusClass::Mixed}, 40, 3),
                            streams("hazards", config, {StimulusClass::Hazards, StimulusClass::SwapHazards}, 60, 2),
                            directed("registers", config, testbench::check_registers),
                            directed("refusals", config, testbench::check_refusals),
                            streams("resets", config, {StimulusClass::Reset}, 60, 4),
                            must_fail(config),
                            directed("short resets", config, testbench::check_short_resets),
                            streams("all classes", config, testbench::stimulus_classes(), 60, 3),
                            streams("late source", config, {StimulusClass::Mixed}, 20, 4, "every-97")};
  // Sheets that freeze pixels while the table of the one before is built are rare.
  if (config.culls()) {
    checks.push_back(streams("culling", config, testbench::stimulus_classes(), 400, 4));
    checks.push_back(streams("left out", config, {StimulusClass::Mixed}, 300, 8, "all", true));
  }
  return checks;
}

}  // namespace
}  // namespace fastsplat::test

int main(int argc, char** argv) {
  return fastsplat::test::mutants_main(
      argc, argv, [](const char* path) { return fastsplat::test::checks_of(fastsplat::driver::load_config(path)); });
}
