// SPDX-License-Identifier: Apache-2.0
// Scripts for schedulers that this program does not call itself: array jobs for LSF and SGE, and a list of one command
// per line for GNU parallel and similar tools.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/submission.hpp"

namespace fastsplat::plan {

/// An array script for every array with tasks to do, the merge script and the command list, in this order. Tasks
/// without remaining cases end at once, so that arrays are submitted whole.
std::vector<ScriptFile> engine_scripts(const Submission& submission);

/// Shell commands that submit the files, one paragraph per scheduler.
std::string engine_recipes(const Submission& submission);

}  // namespace fastsplat::plan
