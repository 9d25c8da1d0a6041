// SPDX-License-Identifier: Apache-2.0
// Flags shared by the subcommands of `plan`: the plan's file and the folder of its results.
#pragma once

#include <string>

#include "cli/common.hpp"

namespace fastsplat::cli {

struct PlanFlags {
  std::string plan;                    ///< the file that `plan make` wrote
  std::optional<std::string> results;  ///< folder; absent: the plan's name with .results
  std::string folder() const;
};

void declare(Options& options, PlanFlags& to);

}  // namespace fastsplat::cli
