// Slurm as its clients tell of it: what the site allows, what is queued, what is sent and taken back.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fastsplat::plan {

/// Tasks that one array may have (MaxArraySize: indices are below it). Throws UserError (Input) where Slurm does not
/// say, or allows no arrays.
std::size_t slurm_array_max();

/// Jobs of these names, with commas between, that have not ended: "12 13".
std::string slurm_queued(const std::string& names);

/// Calls sbatch with these words (itself the first): the job's number. Throws UserError (Input) with what sbatch said.
std::string slurm_submit(const std::vector<std::string>& words);

/// Takes jobs back, as well as it can be done.
void slurm_cancel(const std::vector<std::string>& jobs);

}  // namespace fastsplat::plan
