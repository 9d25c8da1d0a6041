// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/slurm_script.hpp"

#include <fmt/format.h>

namespace fastsplat::plan {
namespace {

/// A quoted value for an #SBATCH line, where blanks, quotes and # are special.
std::string directive_value(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

/// Escapes percent signs, which sbatch expands in file names.
std::string in_pattern(const std::string& path) {
  std::string out;
  for (const char c : path) out += c == '%' ? std::string("%%") : std::string(1, c);
  return out;
}

std::string directives(const Submission& s, const std::string& name, const std::string& log, int processors) {
  std::string text;
  const auto add = [&](const std::string& line) { text += "#SBATCH " + line + "\n"; };
  add("--job-name=" + name);
  add("--output=" + directive_value(in_pattern(s.logs().string()) + "/" + log));
  add("--chdir=" + directive_value(s.folder.string()));
  // Keeps the log from before a task was requeued.
  add("--open-mode=append");
  add("--requeue");
  add("--ntasks=1");
  add(fmt::format("--cpus-per-task={}", processors));
  if (!s.partition.empty()) add("--partition=" + directive_value(s.partition));
  if (!s.time.empty()) add("--time=" + s.time);
  for (const auto& own : s.directives) add(own);
  return text;
}

}  // namespace

std::filesystem::path slurm_array_path(const Submission& s, const JobArray& array) {
  return s.scripts() / fmt::format("array-{}.sbatch", array.number);
}

std::filesystem::path slurm_merge_path(const Submission& s) { return s.scripts() / "merge.sbatch"; }

std::string slurm_array_script(const Submission& s, const JobArray& array) {
  return fmt::format(
             "#!/bin/sh\n# {}: shards {} to {} of {}; task 0 is shard {}. To repeat a task: sbatch --array=N THIS\n",
             s.what, array.first, array.first + array.length - 1, s.shards, array.first) +
         directives(s, s.name, fmt::format("array-{}_%a.%A.log", array.number), s.jobs * s.threads) + check_lines(s) +
         "exec " + run_line(s, fmt::format("$((SLURM_ARRAY_TASK_ID + {}))", array.first)) + "\n";
}

std::string slurm_merge_script(const Submission& s) {
  return fmt::format("#!/bin/sh\n# {}: merge after all tasks end\n", s.what) +
         directives(s, s.merge_name(), "merge.%j.log", 1) + merge_lines(s, "slurm");
}

std::vector<ScriptFile> slurm_scripts(const Submission& s) {
  std::vector<ScriptFile> files;
  for (const auto& array : arrays_of(s)) files.push_back({slurm_array_path(s, array), slurm_array_script(s, array)});
  files.push_back({slurm_merge_path(s), slurm_merge_script(s)});
  return files;
}

std::vector<std::string> sbatch_array(const Submission& s, const JobArray& array) {
  std::string tasks = index_ranges(array.tasks);
  if (s.at_once > 0) tasks += fmt::format("%{}", s.at_once);
  return {"sbatch", "--parsable", "--array=" + tasks, slurm_array_path(s, array).string()};
}

std::vector<std::string> sbatch_merge(const Submission& s, const std::vector<std::string>& arrays) {
  std::vector<std::string> words{"sbatch", "--parsable"};
  if (!arrays.empty()) words.push_back(fmt::format("--dependency=afterany:{}", fmt::join(arrays, ":")));
  words.push_back(slurm_merge_path(s).string());
  return words;
}

}  // namespace fastsplat::plan
