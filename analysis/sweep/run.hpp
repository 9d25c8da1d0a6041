// Runs what is left of a plan: each case's runs one after the other, several cases at once, every result published
// whole. Killed anywhere, the next run goes on with what is missing. What the machine did to a case is reported, and
// the case is left for the next run.
#pragma once

#include <functional>

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/result.hpp"
#include "base/progress.hpp"

namespace fastsplat::plan {

struct RunOptions {
  std::filesystem::path results;  ///< made if it is not there
  std::string program;            ///< what is run: a path
  std::string program_hash;       ///< of it; goes into every result
  Shard shard{};
  std::size_t jobs = 1;          ///< cases at once
  int threads = 1;               ///< of each run (--threads)
  bool retry_failed = false;     ///< cases that failed are run again
  bool replace_foreign = false;  ///< results of another program are made again, not an error
  Progress progress{};           ///< cases done, of those of the shard
  std::function<void(const Case&, const CaseResult&)> finished{};  ///< called with each result as it is published
  /// Called with the message of each case that has no result.
  std::function<void(const Case&, const std::string&)> accident{};
  std::function<void(const std::string&)> note{};
};

struct RunSummary {
  std::size_t cases = 0;                           ///< of the shard
  std::size_t skipped = 0;                         ///< done before
  std::size_t passed = 0, failed = 0, errors = 0;  ///< of all that are done now, skipped ones too
  std::size_t accidents = 0;                       ///< of the shard, left without a result
  int signal = 0;                                  ///< that stopped it early; else 0
  double cpu_seconds = 0.0;                        ///< of the children
};

/// Throws UserError (Input) before anything is run where the folder holds results of another program or content.
RunSummary run(const Plan& plan, const RunOptions& options);

/// Names in a folder of results besides ID.json.
inline constexpr const char* kSharedFolder = "shared";      ///< what cases share
inline constexpr const char* kTimesFolder = "times";        ///< ID.json: CPU seconds, which no result holds
inline constexpr const char* kFailuresFolder = "failures";  ///< evidence of verifications that failed

}  // namespace fastsplat::plan
