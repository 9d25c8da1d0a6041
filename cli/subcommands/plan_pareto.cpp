// SPDX-License-Identifier: Apache-2.0
// fastsplat plan pareto: the Pareto front of merged results for two metrics.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/sweep/pareto.hpp"
#include "base/version.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/plan_columns.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct PlanParetoArguments {
  Common common;
  RowFlags rows;
  std::string x, y;
  bool markdown = false, beaten = false;
};

using Json = nlohmann::ordered_json;

struct PlanParetoResult {
  plan::Merged merged;
  plan::Pareto pareto;
  plan::Table front, beaten;  ///< as printed
};

/// A table of `rows` with both metrics, and a last column `title` with `last` of each row.
template <class Last>
plan::Table table_of(const PlanParetoResult& result, const std::vector<const plan::Row*>& rows,
                     const plan::TableOptions& options, const char* title, const Last& last) {
  plan::Merged some = result.merged;
  some.rows.clear();
  for (const auto* row : rows) some.rows.push_back(*row);
  plan::TableOptions own{.columns = options.columns, .most = options.most};
  if (own.columns.empty()) {
    // The axes that distinguish the front's rows may not distinguish all rows: use every axis that varies anywhere.
    const auto usual = plan::table_of(result.merged, {}).columns;
    for (const auto& axis : result.merged.axes) {
      if (std::ranges::find(usual, axis.name) != usual.end()) own.columns.push_back(axis.name);
    }
    for (const auto& name : {result.pareto.x.name, result.pareto.y.name}) own.columns.push_back(name);
    own.columns.push_back(plan::fixed_column(result.merged, "config_hash"));
  }
  auto table = plan::table_of(some, own);
  table.columns.emplace_back(title);
  table.titles.emplace_back(title);
  for (std::size_t at = 0; at < table.rows.size(); ++at) table.rows[at].push_back(last(rows[at]));
  return table;
}

PlanParetoResult result_of(const PlanParetoArguments& arguments) {
  PlanParetoResult result{.merged = plan::read_merged(arguments.rows.merged), .pareto = {}, .front = {}, .beaten = {}};
  const auto options = arguments.rows.options();
  result.pareto =
      plan::pareto(plan::chosen_rows(result.merged, options), plan::metric_of(result.merged, arguments.x, "--x"),
                   plan::metric_of(result.merged, arguments.y, "--y"));
  std::map<const plan::Row*, std::size_t> beats;
  for (const auto& [row, by] : result.pareto.beaten) ++beats[by];
  result.front = table_of(result, result.pareto.front, options, "beats", [&](const plan::Row* row) {
    return plan::Cell{std::to_string(beats[row]), static_cast<double>(beats[row])};
  });
  std::vector<const plan::Row*> rows;
  std::map<const plan::Row*, const plan::Row*> by;
  for (const auto& one : result.pareto.beaten) {
    rows.push_back(one.row);
    by[one.row] = one.by;
  }
  result.beaten = table_of(result, rows, options, "dominated by", [&](const plan::Row* row) {
    return plan::Cell{by[row]->id, {}};
  });
  return result;
}

std::string to_text(const PlanParetoResult& result, const PlanParetoArguments& arguments) {
  const auto text_of = [&](const plan::Table& table) {
    return arguments.markdown ? plan::to_markdown(table) : plan::to_text(table);
  };
  const auto& [x, y, front, beaten, without] = result.pareto;
  const std::string heading = fmt::format(
      "{} of {} are on the Pareto front of {} ({} is better) and {} ({} is better){}\n\n", front.size(),
      counted(front.size() + beaten.size(), "row"), x.name, to_string(x.better), y.name, to_string(y.better),
      without.empty() ? "" : fmt::format("; {} without these figures", counted(without.size(), "row")));
  return heading + text_of(result.front) +
         (arguments.beaten
              ? "\ndominated rows, each with the first row of the front that dominates it\n\n" + text_of(result.beaten)
              : "");
}

Json to_json(const PlanParetoResult& result) {
  const auto& [x, y, front, beaten, without] = result.pareto;
  const auto entry = [&x = x, &y = y](const plan::Row* row) {  // Clang 14 captures no part of a structured binding
    return Json{{"id", row->id}, {x.name, *row->metric(x.name)}, {y.name, *row->metric(y.name)}};
  };
  Json json{{"verb", "plan pareto"}, {"version", program_version()}, {"name", result.merged.name}};
  json["x"] = {{"name", x.name}, {"unit", x.unit}, {"better", to_string(x.better)}};
  json["y"] = {{"name", y.name}, {"unit", y.unit}, {"better", to_string(y.better)}};
  json["front"] = Json::array();
  for (const auto* row : front) {
    Json one = entry(row);
    for (const auto& [name, value] : row->axes) one["axes"][name] = plan::to_json(value);
    one["config_hash"] = row->content.config_hash;
    one["command"] = row->command;
    json["front"].push_back(std::move(one));
  }
  json["beaten"] = Json::array();
  for (const auto& [row, by] : beaten) {
    Json one = entry(row);
    one["by"] = by->id;
    json["beaten"].push_back(std::move(one));
  }
  json["without"] = Json::array();
  for (const auto* row : without) json["without"].push_back(row->id);
  return json;
}

ExitCode run(const PlanParetoArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}, .inputs = {arguments.rows.merged}});
  const PlanParetoResult result = result_of(arguments);
  output.line(to_text(result, arguments));
  output.json(to_json(result));
  return ExitCode::Pass;
}

void declare(Options& options, PlanParetoArguments& to) {
  declare(options, to.rows);
  options.group("Metrics");
  options.required("--x", to.x, "METRIC", "a metric, with - before it if less is better, + if more is better");
  options.required("--y", to.y, "METRIC", "another");
  options.group("Output");
  options.flag("--beaten", to.beaten, "also list dominated rows, each with a row that dominates it");
  options.flag("--markdown", to.markdown, "print Markdown tables");
  declare(options, to.common);
  options.example("fastsplat plan pareto merged.json --x cost --y psnr_db", "the cases that no other case dominates");
  options.example("fastsplat plan pareto merged.json --x cost --y psnr_db --beaten",
                  "the same with all dominated cases");
}

}  // namespace

const Subcommand subcommands::plan_pareto{"plan pareto", "list the Pareto front of two metrics",
                                          subcommand<PlanParetoArguments, declare, run>};

}  // namespace fastsplat::cli
