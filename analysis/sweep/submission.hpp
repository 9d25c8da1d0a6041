// SPDX-License-Identifier: Apache-2.0
// A plan submitted to other machines: shards become tasks, tasks become arrays within the site's limit. Also the lines
// that the scripts of all engines share (docs/cluster.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace fastsplat::plan {

/// A submission. All paths are absolute: a task may start in any folder, and its node sees the same folders.
struct Submission {
  std::string name;               ///< name of the jobs: letters, digits, . _ -
  std::string what;               ///< "plan head-bits, 240 cases", for the scripts' first lines
  std::filesystem::path program;  ///< this program
  std::filesystem::path plan, results, merged;
  std::filesystem::path folder;           ///< working folder of the cases: names of volumes may be relative to it
  std::size_t shards = 1;                 ///< tasks in all, done ones too
  std::vector<std::size_t> to_do{};       ///< shards with missing results, from 1, ascending
  std::size_t array_max = 1000;           ///< most tasks in an array
  int jobs = 1;                           ///< cases at a time in a task
  int threads = 1;                        ///< of each run of a case
  std::string partition{}, time{};        ///< empty: the site's default
  std::size_t at_once = 0;                ///< most tasks of an array at a time; 0: no limit
  std::vector<std::string> directives{};  ///< passed to sbatch unchanged: "--account=chips"

  /// Scripts and logs, beside the results.
  std::filesystem::path scripts() const { return results / "submit"; }
  /// Name of the merge job, which runs after all others.
  std::string merge_name() const { return name + "-merge"; }
  std::filesystem::path logs() const { return scripts() / "log"; }
};

/// A job's name from plan and folder; equal for equal arguments, so that queued jobs are found again.
std::string job_name(const std::string& plan_name, const std::string& plan_hash, const std::filesystem::path& results);

/// A file of scripts(), written before anything is submitted.
struct ScriptFile {
  std::filesystem::path path;
  std::string text;
};

/// One array: task t, from 0, is shard first + t of the plan.
struct JobArray {
  std::size_t number = 1;          ///< among the arrays of the submission, empty ones counted
  std::size_t first = 1;           ///< shard of task 0
  std::size_t length = 0;          ///< tasks, done ones too
  std::vector<std::size_t> tasks;  ///< tasks to submit
};

/// The shards to do as arrays of at most `array_max` tasks; arrays without such shards are left out.
std::vector<JobArray> arrays_of(const Submission& submission);

/// {0, 1, 2, 5} as "0-2,5".
std::string index_ranges(const std::vector<std::size_t>& rising);

/// The command line of the task that computes a shard; `shard` is a number or a shell's expression for one.
std::string run_line(const Submission& submission, const std::string& shard);
std::string merge_line(const Submission& submission);
/// The command line with which the merge lists tasks without results.
std::string lost_line(const Submission& submission, const std::string& engine);

/// Script lines that stop with a message on a machine that cannot read the files.
std::string check_lines(const Submission& submission);
/// Script lines of the merge: wait if a network folder shows files late, merge, list lost tasks.
std::string merge_lines(const Submission& submission, const std::string& engine);

/// Start of the name of a task's log: "array-1_7.", followed by the job number and ".log".
std::string log_stem(const Submission& submission, std::size_t shard);

/// A duration as sbatch takes it ("90", "1:30:00", "2-12", "2-12:30") in seconds; throws UserError (Usage) for others.
long seconds_from(const std::string& time);

}  // namespace fastsplat::plan
