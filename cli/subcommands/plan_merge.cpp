// SPDX-License-Identifier: Apache-2.0
// fastsplat plan merge: a plan's results in one file, one row per case, in the plan's order.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "analysis/sweep/merged.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/json_text.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/plan_arguments.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct PlanMergeArguments {
  Common common;
  PlanFlags plan;
  std::string out;
  bool partial = false, allow_foreign = false;
};

std::string to_text(const plan::Merged& merged, const std::string& out) {
  const auto with = [&](plan::Status status) { return std::ranges::count(merged.rows, status, &plan::Row::status); };
  return fmt::format(
      "{}: {}, {} passed, {} failed, {} with errors{}\n{}", merged.name, counted(merged.rows.size(), "row"),
      with(plan::Status::Pass), with(plan::Status::Fail), with(plan::Status::Error),
      merged.missing.empty() ? "" : fmt::format("; {} missing", merged.missing.size()), out.empty() ? "" : out + "\n");
}

/// A foreign file among the results would disturb the next merge.
void refuse_among_results(const std::string& path, const std::string& results) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (path.empty() || path == "-" || !fs::is_directory(results, ignored)) return;
  if (!fs::equivalent(fs::absolute(path).parent_path(), results, ignored)) return;
  throw_usage({.where = path,
               .what = "lies in the folder of results",
               .expected = "another folder than " + results,
               .got = {},
               .fix = "choose another folder"});
}

ExitCode run(const PlanMergeArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.out, arguments.common.json}, .inputs = {arguments.plan.plan}});
  for (const auto& path : {arguments.out, arguments.common.json}) refuse_among_results(path, arguments.plan.folder());
  const auto plan = plan::read_plan(arguments.plan.plan);
  const auto merged = plan::merge(plan, arguments.plan.folder(),
                                  {.partial = arguments.partial, .allow_foreign = arguments.allow_foreign});
  const auto json = plan::to_json(merged);
  if (!arguments.out.empty()) write_text_file(arguments.out, json_text(json, 1) + "\n");
  output.line(to_text(merged, arguments.out));
  if (!merged.missing.empty())
    output.warn(
        fmt::format("{} missing: the rows do not cover the whole plan", counted(merged.missing.size(), "result")));
  for (const auto& metric : plan.metrics) {
    const bool listed = metric.name.find('*') != std::string::npos;  // whose columns have names of their own
    if (listed || std::ranges::find(merged.metrics, metric.name, &plan::Metric::name) != merged.metrics.end()) continue;
    output.warn(fmt::format("metric {}: no result has a number at {}", metric.name, metric.path));
  }
  output.json(json);
  return ExitCode::Pass;
}

void declare(Options& options, PlanMergeArguments& to) {
  declare(options, to.plan);
  options.flag("--partial", to.partial, "merge available results and list the others as missing");
  options.flag("--allow-foreign", to.allow_foreign, "skip results of other plans");
  options.group("Output");
  options.word("-o,--out", to.out, "FILE", "write the rows, .json, the input of table, pareto, csv and report");
  declare(options, to.common);
  options.example("fastsplat plan merge plan.json -o merged.json", "all results in one file");
  options.example("fastsplat plan merge plan.json --results plan.results -o merged.json", "results in another folder");
}

}  // namespace

const Subcommand subcommands::plan_merge{"plan merge", "merge the results of a plan into one file",
                                         subcommand<PlanMergeArguments, declare, run>};

}  // namespace fastsplat::cli
