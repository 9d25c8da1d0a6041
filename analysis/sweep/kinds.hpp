// SPDX-License-Identifier: Apache-2.0
// The kinds of case and the program runs of each. A subcommand not listed here is a kind with one run.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/value.hpp"

namespace fastsplat::plan {

/// A run of a kind, before the settings are inserted.
struct StepOfKind {
  std::string subcommand;
  Words files;               ///< words before the settings: "{model.exr}" as a positional
  Words outputs;             ///< words after them
  bool takes_device = true;  ///< configuration and keys become words, if the subcommand takes them
  bool has_result = true;    ///< its JSON is part of the result
  bool coverage = false;
  std::string shared{};  ///< file that cases share, "golden.exr"; outputs and files name it "{golden.exr}"
};

std::vector<StepOfKind> steps_of(const std::string& kind);

/// Whether a flag cannot be a setting: the run itself passes it, or it writes a file outside the case's folder.
bool is_given_by_run(const std::string& flag);

}  // namespace fastsplat::plan
