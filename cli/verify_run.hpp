// SPDX-License-Identifier: Apache-2.0
// Arguments of `verify` and its runs: a scene, a recorded stream or random streams through the RTL.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "cli/common.hpp"
#include "cli/config_flags.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/output.hpp"
#include "cli/scene_flags.hpp"
#include "cli/wave_flags.hpp"
#include "testbench/faults/planted_fault.hpp"
#include "testbench/stimulus/campaign.hpp"

namespace fastsplat::cli {

struct VerifyArguments {
  Common common;
  SceneFlags scene;
  GaussianFlags gaussians;       ///< instead of a volume's scene
  std::string stream;            ///< a .fss file; empty for none
  std::optional<int> random;     ///< splats per seed
  std::uint64_t seed = 1;        ///< of the first run
  int seeds = 1;                 ///< seed, seed+1, ...
  std::string stimulus = "all";  ///< stimulus class
  std::optional<int> jobs;       ///< as --threads
  ConfigFlags config;
  std::string ready = "always", input = "always", fill = "random";
  std::optional<int> reset_after;     ///< beats before a warm reset
  std::string fault;                  ///< planted fault; empty for none
  std::optional<int> all_mismatches;  ///< runs to the end and lists up to this many mismatches
  std::string coverage;               ///< file to which functional coverage is added; empty for none
  std::string failure;                ///< prefix of a failure's stream and waveform; empty: chosen by source
  std::string save_stream;            ///< files for random streams, # stands for their numbers; empty for none
  std::string junit;                  ///< file for the result as JUnit XML; empty for none
  WaveFlags wave;
};

void declare(Options& options, VerifyArguments& to);

enum class Source { Scene, Stream, Random };
/// UserError (Usage) for flags that cannot be combined.
Source source_from(const VerifyArguments& arguments);

/// Number of streams of a run without failures.
std::uint64_t stream_count(const VerifyArguments& arguments, Source source);

/// UserError (Usage) for an unknown pattern, class or fault, or a fault that the RTL of `config` does not have.
testbench::VerifyOptions options_from(const VerifyArguments& arguments, const cmodel::Config& config);
testbench::CampaignOptions campaign_from(const VerifyArguments& arguments, const testbench::VerifyOptions& options);

/// A result with everything needed to investigate a failure.
struct Checked {
  testbench::VerifyResult result;
  std::uint64_t streams = 1, resets_late = 0;
  testbench::VerifyResult failed;
  std::vector<testbench::SeedResult> by_seed;           ///< of random streams
  std::vector<testbench::StreamResult> by_stream;       ///< likewise
  std::vector<testbench::StreamDivergence> kept;        ///< for --all-mismatches
  std::map<std::string, testbench::Coverage> coverage;  ///< by campaign
  cmodel::BeatSource source;                            ///< of the failed stream, or of the only one
  testbench::VerifyOptions options;                     ///< likewise
};

Checked verify_stream(const VerifyArguments& arguments, const testbench::VerifyOptions& options);
Checked verify_random(const VerifyArguments& arguments, const testbench::VerifyOptions& options,
                      const Progress& progress);
Checked verify_scene(const VerifyArguments& arguments, testbench::VerifyOptions options, const Progress& progress,
                     const Output& output);

}  // namespace fastsplat::cli
