// SPDX-License-Identifier: Apache-2.0
// fastsplat plan csv: merged results for a spreadsheet or a script.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/version.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/plan_columns.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct PlanCsvArguments {
  Common common;
  RowFlags rows;
  std::string out;
};

/// All columns, unless some were named.
plan::TableOptions options_from(const PlanCsvArguments& arguments, const plan::Merged& merged) {
  auto options = arguments.rows.options();
  if (!options.columns.empty()) return options;
  const auto fixed = [&](const char* name) { options.columns.push_back(plan::fixed_column(merged, name)); };
  for (const char* first : {"id", "kind", "status", "message"}) fixed(first);
  for (const auto& axis : merged.axes) options.columns.push_back(axis.name);
  for (const auto& metric : merged.metrics) options.columns.push_back(metric.name);
  for (const char* last : {"config_hash", "scene_hash", "program_hash", "command"}) fixed(last);
  return options;
}

ExitCode run(const PlanCsvArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.out, arguments.common.json}, .inputs = {arguments.rows.merged}});
  const auto merged = plan::read_merged(arguments.rows.merged);
  const auto table = plan::table_of(merged, options_from(arguments, merged));
  if (arguments.out.empty()) {
    output.line(plan::to_csv(table));
  } else {
    write_text_file(arguments.out, plan::to_csv(table));
    output.line(fmt::format("{} in {}", counted(table.rows.size(), "row"), arguments.out));
  }
  output.json(nlohmann::ordered_json{{"verb", "plan csv"},
                                     {"version", program_version()},
                                     {"columns", table.columns},
                                     {"rows", table.rows.size()},
                                     {"file", arguments.out}});
  return ExitCode::Pass;
}

void declare(Options& options, PlanCsvArguments& to) {
  declare(options, to.rows);
  options.group("Output");
  options.word("-o,--out", to.out, "FILE", "write to a file instead of stdout");
  declare(options, to.common);
  options.example("fastsplat plan csv merged.json -o merged.csv", "merged results for a spreadsheet");
  options.example("fastsplat plan csv merged.json", "merged results to stdout, for a pipe");
}

}  // namespace

const Subcommand subcommands::plan_csv{"plan csv",
                                       "print merged results as comma-separated values, with full precision",
                                       subcommand<PlanCsvArguments, declare, run>};

}  // namespace fastsplat::cli
