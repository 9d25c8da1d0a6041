// SPDX-License-Identifier: Apache-2.0
// The campaigns whose coverage closes the verification plan, for one configuration.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "testbench/coverage/coverage_book.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "testbench/stimulus/directed.hpp"

namespace fastsplat::testbench {

struct CoverageVolume {
  std::uint64_t splats = 0;  ///< per seed, shared by the classes
  std::uint64_t seeds = 0;   ///< a multiple of the number of ready patterns: every class meets each
  std::uint64_t resets = 0;  ///< warm resets, in small streams
};

struct CoverageOrder {
  cmodel::Config config;
  CoverageVolume volume;
  std::vector<StimulusClass> classes = stimulus_classes();
  /// Whole frames, each a subset of a stream.
  std::vector<std::pair<std::string, BeatSource>> scenes;
  MakeDevice device;  ///< empty: the Verilated device of the configuration
  int threads = 0;
  std::function<void(const std::string& campaign)> progress;
};

/// Names that a testpoint may give as campaigns, besides the stimulus classes.
inline constexpr const char* kOtherCampaigns[] = {"scene",     "resets",   "left out",
                                                  "registers", "refusals", "short resets"};
/// In a plan: the sum of all campaigns.
inline constexpr const char* kAllCampaigns = "all";

/// Every bin of the configuration but cover points.
Coverage planned_bins(const cmodel::Config& config);

/// If there are `failures`, nothing is closed.
struct CoverageRuns {
  CoverageBook book;
  std::vector<std::string> failures;
};
CoverageRuns run_coverage(const CoverageOrder& order);

}  // namespace fastsplat::testbench
