// What Slurm is given for a submission: a script an array, one that merges, and the words of sbatch.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/submission.hpp"

namespace fastsplat::plan {

std::filesystem::path slurm_array_path(const Submission& submission, const JobArray& array);
std::filesystem::path slurm_merge_path(const Submission& submission);

/// Complete by itself: `sbatch --array=7 FILE` sends a task again by hand. A task that is requeued goes on where the
/// results end; a signal reaches the program itself.
std::string slurm_array_script(const Submission& submission, const JobArray& array);
std::string slurm_merge_script(const Submission& submission);

/// Both: a script for every array with something to do, and the merge.
std::vector<ScriptFile> slurm_scripts(const Submission& submission);

/// sbatch and its words; what it prints is the job's number.
std::vector<std::string> sbatch_array(const Submission& submission, const JobArray& array);
/// Runs after the arrays of these numbers have ended in any way (without numbers: at once). A failed, cancelled or lost
/// task must neither prevent the merge of the other results nor make the merge wait for ever.
std::vector<std::string> sbatch_merge(const Submission& submission, const std::vector<std::string>& arrays);

}  // namespace fastsplat::plan
