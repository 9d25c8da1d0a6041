// SPDX-License-Identifier: Apache-2.0
// Runs the remaining cases of a plan: each case's runs one after the other, several cases at once. Results are
// published atomically, so that after a kill the next run continues with the missing ones. Failures of the machine are
// reported, and their cases are left for the next run.
#pragma once

#include <functional>

#include "analysis/sweep/child.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/result.hpp"
#include "base/progress.hpp"

namespace fastsplat::plan {

struct RunOptions {
  std::filesystem::path results;  ///< created if absent
  Program program;
  std::string program_hash;       ///< its hash, part of every result
  Shard shard{};
  std::size_t jobs = 1;          ///< cases at once
  int threads = 1;               ///< of each run (--threads)
  bool retry_failed = false;     ///< cases that failed are run again
  bool replace_foreign = false;  ///< results of another program are replaced, not refused
  Progress progress{};           ///< counts finished cases of the shard
  std::function<void(const Case&, const CaseResult&)> finished{};  ///< called with each result as it is published
  /// Asked after each run: which input of the plan has changed, as a message; empty if none has. The run is then an
  /// accident.
  std::function<std::string()> changed{};
  /// Called when a case has a result and others wait. Work that later children share can be done here: a child has
  /// already survived it.
  std::function<void(const Case&)> unharmed{};
  /// Called with the message of each case that has no result.
  std::function<void(const Case&, const std::string&)> accident{};
  std::function<void(const std::string&)> note{};
};

struct RunSummary {
  std::size_t cases = 0;                           ///< of the shard
  std::size_t skipped = 0;                         ///< done before
  std::size_t passed = 0, failed = 0, errors = 0;  ///< of all finished cases, skipped ones included
  std::size_t accidents = 0;                       ///< of the shard, left without a result
  int signal = 0;                                  ///< the signal that stopped it early; else 0
  double cpu_seconds = 0.0;                        ///< of the children
};

/// Throws UserError (Input), before running anything, if the folder holds results of another program or content.
RunSummary run(const Plan& plan, const RunOptions& options);

/// Names in a folder of results besides ID.json.
inline constexpr const char* kSharedFolder = "shared";      ///< what cases share
inline constexpr const char* kTimesFolder = "times";        ///< ID.json: CPU seconds, which results do not contain
inline constexpr const char* kFailuresFolder = "failures";  ///< evidence of failed verifications

}  // namespace fastsplat::plan
