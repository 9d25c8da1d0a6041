// SPDX-License-Identifier: Apache-2.0
#include "cli/plan_arguments.hpp"

#include <filesystem>

namespace fastsplat::cli {

std::string PlanFlags::folder() const {
  return results ? *results : std::filesystem::path(plan).replace_extension(".results").string();
}

void declare(Options& options, PlanFlags& to) {
  options.positional("PLAN", to.plan, "a plan written by `fastsplat plan make`");
  options.group("Results");
  options.word("--results", to.results, "FOLDER",
               "folder of the results, one file per case (for PLAN.json: PLAN.results)");
}

}  // namespace fastsplat::cli
