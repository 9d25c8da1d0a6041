// SPDX-License-Identifier: Apache-2.0
// The scripts and sbatch command lines of a submission to Slurm: one script per array, and one that merges.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/submission.hpp"

namespace fastsplat::plan {

std::filesystem::path slurm_array_path(const Submission& submission, const JobArray& array);
std::filesystem::path slurm_merge_path(const Submission& submission);

/// Self-contained: `sbatch --array=7 FILE` repeats a task by hand. A requeued task continues after the last result;
/// signals reach the program itself.
std::string slurm_array_script(const Submission& submission, const JobArray& array);
std::string slurm_merge_script(const Submission& submission);

/// All scripts: one for every array with tasks to do, and the merge.
std::vector<ScriptFile> slurm_scripts(const Submission& submission);

/// The sbatch command line of an array; it prints the job's number.
std::vector<std::string> sbatch_array(const Submission& submission, const JobArray& array);
/// The same for the merge, which runs after the arrays of these numbers have ended in any way (without numbers: at
/// once). A failed, cancelled or lost task must neither prevent the merge of the other results nor block it.
std::vector<std::string> sbatch_merge(const Submission& submission, const std::vector<std::string>& arrays);

}  // namespace fastsplat::plan
