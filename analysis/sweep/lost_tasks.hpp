// SPDX-License-Identifier: Apache-2.0
// Which cases of a plan have no result yet, and which tasks of a submission have to produce them.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/submission.hpp"

namespace fastsplat::plan {

/// Indices of the cases that `plan run` would still run: without a result, or with a damaged one. Throws UserError
/// (Input) for a result of another program, which `plan run` would refuse.
std::vector<std::size_t> cases_to_do(const Plan& plan, const std::filesystem::path& results,
                                     const std::string& program_hash);

/// The shards, of `count`, that hold these cases; counted from 1, ascending.
std::vector<std::size_t> shards_of(const std::vector<std::size_t>& cases, std::size_t count);

/// A task that ended without all of its results, or never began.
struct LostTask {
  std::size_t shard = 1;
  std::vector<std::string> cases;  ///< ids
  std::filesystem::path log;       ///< the latest; empty: none
};
std::vector<LostTask> lost_tasks(const Plan& plan, const Submission& submission, const std::vector<std::size_t>& cases);

}  // namespace fastsplat::plan
