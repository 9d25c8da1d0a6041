// SPDX-License-Identifier: Apache-2.0
// Many random streams through the checked RTL.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "testbench/check/verify.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {

struct CampaignOptions {
  VerifyOptions
      verify;  ///< seed: of the first run; ready or input `all`: each stream takes the next of Pattern::examples()
  std::uint64_t splats = 1000;  ///< per seed, shared by the classes
  std::uint64_t seeds = 1;      ///< seed, seed+1, ...
  std::vector<StimulusClass> classes = stimulus_classes();
  bool keep_going = false;  ///< runs all, even after failures
  bool as_files = false;    ///< streams are laid out as files (arranged()); UserError (Usage) if no image holds them
  int threads = 0;          ///< streams in parallel; 0: all cores. Never changes a result.
  std::function<void(std::size_t done, std::size_t of)> progress;
};

/// One stream of a campaign: its beats and the options it ran with.
struct CampaignRun {
  StimulusClass which{};
  VerifyOptions options;
  std::vector<cmodel::Beat> beats;
  bool reset_late = false;  ///< the stream is too short for its reset, which comes after the last beat
};
std::size_t run_count(const CampaignOptions& options);
CampaignRun make_run(const CampaignOptions& options, std::size_t index);

/// Result of a seed's streams, all classes together.
struct SeedResult {
  std::uint64_t seed = 0;
  Verdict verdict = Verdict::Pass;  ///< of the first of them that did not pass
  std::uint64_t streams = 0, splats = 0, comparisons = 0, mismatches = 0, cycles = 0;
};

/// Result of one stream.
struct StreamResult {
  std::uint64_t seed = 0;
  StimulusClass which{};
  std::string ready, input;  ///< the patterns it ran with
  Verdict verdict = Verdict::Pass;
  std::uint64_t splats = 0, comparisons = 0, mismatches = 0, cycles = 0;
};

/// A divergence and its run.
struct StreamDivergence {
  std::size_t run = 0;  ///< index into CampaignResult::by_stream
  Divergence divergence;
};

struct CampaignResult {
  VerifyResult total;                          ///< sums; first divergence and error are the first failed run's
  std::uint64_t streams = 0;                   ///< run: all, or those up to the failed one
  std::uint64_t resets_late = 0;               ///< streams too short for their reset
  std::map<StimulusClass, Coverage> coverage;  ///< of each class's streams, if asked for
  std::vector<SeedResult> by_seed;             ///< in their order, as far as they were run
  std::vector<StreamResult> by_stream;         ///< likewise
  std::vector<StreamDivergence> kept;          ///< the first VerifyOptions::keep of all streams, in their order
  std::optional<std::size_t> failed;           ///< first run that did not pass
  std::optional<VerifyResult> failure;         ///< its result
};

/// Runs all, or without keep_going up to the first that fails: its result and the sums up to it are the same for any
/// number of threads.
CampaignResult run_campaign(const CampaignOptions& options);

}  // namespace fastsplat::testbench
