// SPDX-License-Identifier: Apache-2.0
// fastsplat plan table: merged results as text or Markdown.
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

struct PlanTableArguments {
  Common common;
  RowFlags rows;
  std::string out;
  bool markdown = false;
};

using Json = nlohmann::ordered_json;

Json to_json(const plan::Table& table) {
  Json json{
      {"verb", "plan table"}, {"version", program_version()}, {"columns", table.columns}, {"rows", Json::array()}};
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const auto& cell : row) cells.push_back(cell.number ? Json(*cell.number) : Json(cell.text));
    json["rows"].push_back(std::move(cells));
  }
  json["left_out"] = table.left_out;
  return json;
}

ExitCode run(const PlanTableArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.out, arguments.common.json}, .inputs = {arguments.rows.merged}});
  const auto table = plan::table_of(plan::read_merged(arguments.rows.merged), arguments.rows.options());
  const std::string text = arguments.markdown ? plan::to_markdown(table) : plan::to_text(table);
  if (arguments.out.empty()) {
    output.line(text);
  } else {
    write_text_file(arguments.out, text);
  }
  output.json(to_json(table));
  return ExitCode::Pass;
}

void declare(Options& options, PlanTableArguments& to) {
  declare(options, to.rows);
  options.group("Output");
  options.flag("--markdown", to.markdown, "print a Markdown table");
  options.word("-o,--out", to.out, "FILE", "write to a file instead of stdout");
  declare(options, to.common);
  options.example("fastsplat plan table merged.json --columns snap.phases,psnr_db,cost --sort -psnr_db",
                  "one row per case, the best first");
  options.example("fastsplat plan table merged.json --markdown -o table.md", "a Markdown table for a review");
}

}  // namespace

const Subcommand subcommands::plan_table{"plan table", "print selected rows and columns of merged results, sorted",
                                         subcommand<PlanTableArguments, declare, run>};

}  // namespace fastsplat::cli
