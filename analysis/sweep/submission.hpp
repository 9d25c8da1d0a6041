// A plan given to other machines: its shards as tasks, tasks as arrays no longer than the site allows, and what every
// engine's scripts are made of (docs/cluster.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace fastsplat::plan {

/// What is sent. All paths are absolute: a task starts wherever its node likes, and sees the same folders.
struct Submission {
  std::string name;               ///< of the jobs: letters, digits, . _ -
  std::string what;               ///< "plan head-bits, 240 cases", for the scripts' first lines
  std::filesystem::path program;  ///< this one
  std::filesystem::path plan, results, merged;
  std::filesystem::path folder;           ///< where the cases' words hold: names of volumes may be relative
  std::size_t shards = 1;                 ///< tasks in all, done ones too
  std::vector<std::size_t> to_do{};       ///< shards with cases that have no result, from 1, rising
  std::size_t array_max = 1000;           ///< tasks of one array
  int jobs = 1;                           ///< cases at a time in a task
  int threads = 1;                        ///< of each run of a case
  std::string partition{}, time{};        ///< empty: the site's own
  std::size_t at_once = 0;                ///< tasks of an array at a time; 0: as many as there is room for
  std::vector<std::string> directives{};  ///< for sbatch, as they are: "--account=chips"

  /// Scripts and logs, beside the results.
  std::filesystem::path scripts() const { return results / "submit"; }
  /// The merge's job, after all others.
  std::string merge_name() const { return name + "-merge"; }
  std::filesystem::path logs() const { return scripts() / "log"; }
};

/// "head-bits" of plan and folder as a job's name; the same for the same two, so that what is queued is found again.
std::string job_name(const std::string& plan_name, const std::string& plan_hash, const std::filesystem::path& results);

/// A file of scripts(), written before anything is sent.
struct ScriptFile {
  std::filesystem::path path;
  std::string text;
};

/// One array: task t, from 0, is shard first + t of the plan.
struct JobArray {
  std::size_t number = 1;          ///< of the arrays of the submission, whether or not it has tasks
  std::size_t first = 1;           ///< shard of task 0
  std::size_t length = 0;          ///< tasks, done ones too
  std::vector<std::size_t> tasks;  ///< that are sent
};

/// The shards to do as arrays of at most `array_max` tasks; arrays with nothing to do are left out.
std::vector<JobArray> arrays_of(const Submission& submission);

/// {0, 1, 2, 5} as "0-2,5".
std::string index_ranges(const std::vector<std::size_t>& rising);

/// The words of the task that computes a shard; `shard` is a number or a shell's expression for one.
std::string run_line(const Submission& submission, const std::string& shard);
std::string merge_line(const Submission& submission);
/// What the merge says of tasks whose cases have no result.
std::string lost_line(const Submission& submission, const std::string& engine);

/// Lines that end a script at once, saying why, on a machine that does not see what it needs.
std::string check_lines(const Submission& submission);
/// The merge as lines of a script: waits where a network folder shows files late, merges, names what was lost.
std::string merge_lines(const Submission& submission, const std::string& engine);

/// Where the task of a shard talks: "array-1_7.", which the engine's job number and ".log" follow.
std::string log_stem(const Submission& submission, std::size_t shard);

/// A duration as sbatch takes it ("90", "1:30:00", "2-12", "2-12:30") in seconds; throws UserError (Usage) for others.
long seconds_from(const std::string& time);

}  // namespace fastsplat::plan
