// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/lost_tasks.hpp"

#include <algorithm>
#include <map>

#include "analysis/sweep/result.hpp"
#include "base/error.hpp"

namespace fastsplat::plan {
namespace {

namespace fs = std::filesystem;

bool is_done(const Case& one, const fs::path& path, const std::string& program_hash) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return false;
  CaseResult result;
  try {
    result = read_result(path);
  } catch (const UserError&) {
    return false;  // `plan run` repeats the case and reports it
  }
  if (const auto why = foreign(result, one, program_hash); !why.empty()) {
    throw_input({.where = path.string(),
                 .what = why,
                 .expected = "program " + program_hash,
                 .got = {},
                 .fix = "use another folder (--results), or replace such results with `fastsplat plan run --again`"});
  }
  return true;
}

/// The latest log of a shard's task; each submission of the task has its own.
fs::path latest_log(const Submission& submission, std::size_t shard) {
  fs::path latest;
  fs::file_time_type when;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(submission.logs(), ignored)) {
    if (!entry.path().filename().string().starts_with(log_stem(submission, shard))) continue;
    const auto written = entry.last_write_time(ignored);
    if (latest.empty() || written > when) {
      latest = entry.path();
      when = written;
    }
  }
  return latest;
}

}  // namespace

std::vector<std::size_t> cases_to_do(const Plan& plan, const fs::path& results, const std::string& program_hash) {
  std::vector<std::size_t> to_do;
  for (std::size_t at = 0; at < plan.cases.size(); ++at) {
    if (!is_done(plan.cases[at], result_path(results, plan.cases[at].id), program_hash)) to_do.push_back(at);
  }
  return to_do;
}

std::vector<std::size_t> shards_of(const std::vector<std::size_t>& cases, std::size_t count) {
  std::vector<std::size_t> shards;
  for (std::size_t index = 1; index <= count; ++index) {
    const Shard shard{.index = index, .of = count};
    if (std::ranges::any_of(cases, [&](std::size_t at) { return shard.has(at); })) shards.push_back(index);
  }
  return shards;
}

std::vector<LostTask> lost_tasks(const Plan& plan, const Submission& submission,
                                 const std::vector<std::size_t>& cases) {
  std::vector<LostTask> lost;
  for (const std::size_t index : shards_of(cases, submission.shards)) {
    LostTask task{.shard = index, .cases = {}, .log = latest_log(submission, index)};
    for (const std::size_t at : cases) {
      if (Shard{.index = index, .of = submission.shards}.has(at)) task.cases.push_back(plan.cases[at].id);
    }
    lost.push_back(std::move(task));
  }
  return lost;
}

}  // namespace fastsplat::plan
