// SPDX-License-Identifier: Apache-2.0
// The progress of a plan, from its folder of results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/sweep/plan.hpp"

namespace fastsplat::plan {

struct Count {
  std::size_t cases = 0, passed = 0, failed = 0, errors = 0;
  std::size_t again = 0;     ///< will be run again: damaged, or of another program or content
  std::size_t missing = 0;   ///< not begun, or in progress
  double cpu_seconds = 0.0;  ///< of cases with a recorded time
  std::size_t timed = 0;     ///< number of these
};

struct PlanStatus {
  Count all;
  std::vector<Count> shards;          ///< if requested
  std::vector<std::string> troubles;  ///< "ID: message" of cases that failed or will be run again
};

/// `program`: hash of the program that would run it. An absent folder has no results.
PlanStatus status_of(const Plan& plan, const std::filesystem::path& results, const std::string& program,
                     std::size_t shards);

}  // namespace fastsplat::plan
