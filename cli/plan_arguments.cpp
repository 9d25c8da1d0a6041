#include "cli/plan_arguments.hpp"

#include <filesystem>

namespace fastsplat::cli {

std::string PlanFlags::folder() const {
  return results ? *results : std::filesystem::path(plan).replace_extension(".results").string();
}

void declare(Options& options, PlanFlags& to) {
  options.positional("PLAN", to.plan, "what `fastsplat plan make` wrote");
  options.group("Results");
  options.word("--results", to.results, "FOLDER", "where results lie, a file a case; PLAN.json: PLAN.results");
}

}  // namespace fastsplat::cli
