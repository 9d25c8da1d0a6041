// The kinds of case: which runs of the program one is. A verb that is not named here is a kind of one run.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/value.hpp"

namespace fastsplat::plan {

/// A run of a kind, before the settings are put into its words.
struct StepOfKind {
  std::string verb;
  Words files;               ///< words before the settings: "{model.exr}" as a positional
  Words outputs;             ///< words after them
  bool takes_device = true;  ///< configuration and keys are words of it, where the verb has them
  bool has_result = true;    ///< its JSON is part of the result
  bool coverage = false;
  std::string shared{};  ///< the stem of the file that cases share, "golden"; outputs and files name it "{golden.exr}"
};

std::vector<StepOfKind> steps_of(const std::string& kind);

/// Flags that no setting may be: the run itself gives them, or they write a file outside the case's folder.
bool is_given_by_run(const std::string& flag);

}  // namespace fastsplat::plan
