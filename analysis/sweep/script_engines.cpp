// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/script_engines.hpp"

#include <fmt/format.h>

#include "base/shell_word.hpp"

namespace fastsplat::plan {
namespace {

std::filesystem::path array_path(const Submission& s, const JobArray& array) {
  return s.scripts() / fmt::format("array-{}.sh", array.number);
}
std::filesystem::path merge_path(const Submission& s) { return s.scripts() / "merge.sh"; }
std::filesystem::path commands_path(const Submission& s) { return s.scripts() / "commands.txt"; }

std::string array_name(const Submission& s, const JobArray& array) {
  return fmt::format("{}-{}", s.name, array.number);
}

/// LSF's hours:minutes, rounded up, and SGE's hours:minutes:seconds.
std::string hours_minutes(long seconds) {
  const long minutes = (seconds + 59) / 60;
  return fmt::format("{}:{:02}", minutes / 60, minutes % 60);
}
std::string hours_minutes_seconds(long seconds) {
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

/// Directives for both schedulers: lines begin with #BSUB for LSF and with #$ for SGE. They contain no paths, because
/// neither documents how to quote them; the script redirects its output itself.
std::string directives(const Submission& s, const std::string& name, int processors) {
  std::string text;
  const auto both = [&](const std::string& lsf, const std::string& sge) {
    text += "#BSUB " + lsf + "\n#$ " + sge + "\n";
  };
  both("-o /dev/null", "-o /dev/null");
  both("-r", "-r y");  // a task whose machine is lost is run again
  text += "#$ -j y\n#$ -S /bin/sh\n#$ -N " + name + "\n";
  if (processors > 1)
    text += fmt::format("#BSUB -n {0}\n#BSUB -R \"span[hosts=1]\"\n# SGE: add -pe ENVIRONMENT {0}\n", processors);
  if (!s.partition.empty()) both("-q " + s.partition, "-q " + s.partition);
  if (!s.time.empty()) {
    const long seconds = seconds_from(s.time);
    both("-W " + hours_minutes(seconds), "-l h_rt=" + hours_minutes_seconds(seconds));
  }
  return text;
}

std::string array_script(const Submission& s, const JobArray& array) {
  return fmt::format(
             "#!/bin/sh\n# {}: shards {} to {} of {}, an array of {} tasks for LSF or SGE\n"
             "#BSUB -J \"{}[1-{}]{}\"\n#$ -t 1-{}\n",
             s.what, array.first, array.first + array.length - 1, s.shards, array.length, array_name(s, array),
             array.length, s.at_once > 0 ? fmt::format("%{}", s.at_once) : "", array.length) +
         (s.at_once > 0 ? fmt::format("#$ -tc {}\n", s.at_once) : "") +
         directives(s, array_name(s, array), s.jobs * s.threads) +
         "# Without an array LSF sets 0 and SGE \"undefined\".\n"
         "task=${SGE_TASK_ID:-$LSB_JOBINDEX}\n"
         "case $task in '' | 0 | *[!0-9]*) echo \"not a task of an array: submit this script with bsub or qsub\" >&2; "
         "exit 2 ;; "
         "esac\n" +
         fmt::format("exec >>{}/array-{}_$((task - 1)).log 2>&1\n", shell_word(s.logs()), array.number) + check_lines(s) +
         "exec " + run_line(s, fmt::format("$((task + {}))", array.first - 1)) + "\n";
}

std::string merge_script(const Submission& s) {
  return fmt::format("#!/bin/sh\n# {}: merge after all tasks end\n#BSUB -J {}\n", s.what, s.merge_name()) +
         directives(s, s.merge_name(), 1) +
         // Started by hand, or after GNU parallel, it writes to its caller's output.
         fmt::format("[ -z \"$JOB_ID$LSB_JOBID\" ] || exec >>{}/merge.log 2>&1\n", shell_word(s.logs())) +
         merge_lines(s, "script");
}

std::string command_list(const Submission& s) {
  std::string text;
  for (const std::size_t shard : s.to_do)
    text += "cd " + shell_word(s.folder) + " && " + run_line(s, std::to_string(shard)) + "\n";
  return text;
}

}  // namespace

std::vector<ScriptFile> engine_scripts(const Submission& s) {
  std::vector<ScriptFile> files;
  for (const auto& array : arrays_of(s)) files.push_back({array_path(s, array), array_script(s, array)});
  files.push_back({merge_path(s), merge_script(s)});
  files.push_back({commands_path(s), command_list(s)});
  return files;
}

std::string engine_recipes(const Submission& s) {
  std::string lsf = "LSF\n", sge = "SGE\n", after, held;
  const std::string merge = shell_word(merge_path(s));
  for (const auto& array : arrays_of(s)) {
    const std::string path = shell_word(array_path(s, array));
    lsf += "  bsub < " + path + "\n";
    sge += "  qsub " + path + "\n";
    after += (after.empty() ? "" : " && ") + fmt::format("ended({})", array_name(s, array));
    held += (held.empty() ? "" : ",") + array_name(s, array);
  }
  lsf += after.empty() ? "  bsub < " + merge + "\n" : "  bsub -w \"" + after + "\" < " + merge + "\n";
  sge += held.empty() ? "  qsub " + merge + "\n" : "  qsub -hold_jid " + held + " " + merge + "\n";
  return lsf + sge +
         fmt::format("GNU parallel\n  parallel --jobs 2 < {}; sh {}\n", shell_word(commands_path(s)), merge);
}

}  // namespace fastsplat::plan
