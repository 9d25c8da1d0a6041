// SPDX-License-Identifier: Apache-2.0
// fastsplat plan make: expands a specification's axes into cases, each named by its content hash.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "analysis/sweep/make.hpp"
#include "base/atomic_file.hpp"
#include "base/json_text.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/plan_vocabulary.hpp"
#include "cli/progress_bar.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct PlanMakeArguments {
  Common common;
  std::string spec, out;
};

std::string to_text(const plan::Made& made, const PlanMakeArguments& arguments) {
  std::string axes;
  for (const auto& axis : made.plan.axes)
    axes += fmt::format("{}{} ({})", axes.empty() ? "" : ", ", axis.name, axis.values.size());
  return fmt::format("plan {} {}: {} of kind {}\naxes: {}\n{}", made.plan.name, made.plan.hash,
                     counted(made.plan.cases.size(), "case"), made.plan.cases.front().kind, axes,
                     arguments.out.empty() ? "" : arguments.out + "\n");
}

/// The specification and the files named by its settings; words that name no file are harmless.
std::vector<std::string> inputs_of(const PlanMakeArguments& arguments, const plan::Plan& plan) {
  std::set<std::string> words;
  for (const auto& one : plan.cases) {
    for (const auto& setting : one.settings) {
      if (const auto* text = std::get_if<std::string>(&setting.value)) words.insert(*text);
    }
  }
  return joined({arguments.spec}, {words.begin(), words.end()});
}

ExitCode run(const PlanMakeArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.out, arguments.common.json}, .inputs = {arguments.spec}});
  const auto made = [&] {
    ProgressBar bar("plan", watching(arguments.common));
    return plan::make(plan::read_spec(arguments.spec), plan_vocabulary(), bar.callback());
  }();
  check_outputs({.others = {arguments.out, arguments.common.json}, .inputs = inputs_of(arguments, made.plan)});
  const auto json = plan::to_json(made.plan);
  if (!arguments.out.empty()) write_text_file(arguments.out, json_text(json, 1) + "\n");
  output.line(to_text(made, arguments));
  if (!made.left_out.empty()) {
    output.note(fmt::format("{} left out, for example: {}", counted(made.left_out.size(), "combination"),
                            made.left_out.front()));
  }
  output.json(json);
  return ExitCode::Pass;
}

void declare(Options& options, PlanMakeArguments& to) {
  options.positional("SPEC", to.spec, "a specification, .toml: kind of case, axes, constants (docs/plan.md)");
  options.group("Output");
  options.word("-o,--out", to.out, "FILE", "write the plan, .json, the input of the other subcommands");
  declare(options, to.common);
  options.example("fastsplat plan make configs/plans/word-lengths.toml -o plan.json", "the cases of a specification");
  options.example("fastsplat plan make configs/plans/word-lengths.toml --json -", "the plan as JSON on stdout");
}

}  // namespace

const Subcommand subcommands::plan_make{"plan make", "expand the axes of a specification into cases",
                                        subcommand<PlanMakeArguments, declare, run>};

}  // namespace fastsplat::cli
