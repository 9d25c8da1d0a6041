// SPDX-License-Identifier: Apache-2.0
// Calls Slurm's clients: reads the site's limits and the queue, submits and cancels jobs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fastsplat::plan {

/// Largest number of tasks in an array (MaxArraySize: indices are below it). Throws UserError (Input) if Slurm does not
/// report it or does not allow arrays.
std::size_t slurm_array_max();

/// Jobs of these names (comma-separated) that have not ended: "12 13".
std::string slurm_queued(const std::string& names);

/// Calls sbatch with these words (itself the first); returns the job's number. Throws UserError (Input) with its
/// message.
std::string slurm_submit(const std::vector<std::string>& words);

/// Cancels jobs; ignores failures.
void slurm_cancel(const std::vector<std::string>& jobs);

}  // namespace fastsplat::plan
