// Scripts for schedulers that this program does not call itself: array jobs that LSF and SGE both read, and a command a
// line for GNU parallel or whatever else runs lines.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/submission.hpp"

namespace fastsplat::plan {

/// An array script for every array with something to do, the merge script and the command list, in this order. A task
/// whose cases are done ends at once, so that arrays are sent whole.
std::vector<ScriptFile> engine_scripts(const Submission& submission);

/// How the files are sent, a scheduler a paragraph: what a user copies into a shell.
std::string engine_recipes(const Submission& submission);

}  // namespace fastsplat::plan
