// How far a plan has come, by its results' folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/sweep/plan.hpp"

namespace fastsplat::plan {

struct Count {
  std::size_t cases = 0, passed = 0, failed = 0, errors = 0;
  std::size_t again = 0;     ///< will be run again: damaged, or of another program or content
  std::size_t missing = 0;   ///< not begun, or under way
  double cpu_seconds = 0.0;  ///< of those with a result
  std::size_t timed = 0;     ///< of them
};

struct PlanStatus {
  Count all;
  std::vector<Count> shards;          ///< where asked for
  std::vector<std::string> troubles;  ///< ID: message, of what failed or will be run again
};

/// `program`: what would run it. A folder that is not there holds no result.
PlanStatus status_of(const Plan& plan, const std::filesystem::path& results, const std::string& program,
                     std::size_t shards);

}  // namespace fastsplat::plan
