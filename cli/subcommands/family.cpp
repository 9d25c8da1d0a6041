// SPDX-License-Identifier: Apache-2.0
// fastsplat family: cost and error of every index kind.
#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "analysis/index_kinds/family_text.hpp"
#include "analysis/index_kinds/head.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/common.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct FamilyArguments {
  Common common;
  std::string kind;
  std::optional<int> entries;
  bool head = false;
};

using Json = nlohmann::ordered_json;

Json to_json(const analysis::FieldError& error) {
  return {{"max", error.largest}, {"rms", error.rms}, {"bias", error.bias}};
}

Json to_json(const std::vector<analysis::FamilyCell>& cells) {
  Json json = Json::array();
  for (const auto& cell : cells) {
    Json remarks = Json::array();
    for (const auto remark : cell.remarks) remarks.push_back(analysis::sentence(remark));
    const auto& o = cell.operations;
    Json row{{"kind", analysis::name_of(cell.config.index())},
             {"config_hash", hash_text(cmodel::config_hash(cell.config))},
             {"grid", cell.config.grid()},
             {"radius", cell.radius},
             {"aligned", to_json(cell.aligned)},
             {"turned", to_json(cell.turned)},
             {"predicted", {{"snap_rms", cell.snap_rms}, {"bits", cell.bits_predicted}}},
             {"bits", cell.bits},
             {"adds", o.adds},
             {"multiplies", o.multiplies},
             {"reads", o.reads},
             {"root_steps", o.root_steps},
             {"cycles", cell.cycles},
             {"cycles_formula", o.formula},
             {"nanoseconds", cell.nanoseconds},
             {"remarks", remarks}};
    if (cell.has_table) {
      row["entries"] = cell.config.radial_entries;
      row["predicted"]["index_max"] = cell.index_max;
    }
    json.push_back(std::move(row));
  }
  return json;
}

/// --head covers all kinds and prints text, so it accepts neither --kind, --entries nor --json.
void check(const FamilyArguments& arguments) {
  if (arguments.entries && !std::has_single_bit(static_cast<unsigned>(*arguments.entries))) {
    throw_usage({.where = "--entries",
                 .what = "is not a power of two",
                 .expected = "a power of two",
                 .got = std::to_string(*arguments.entries),
                 .fix = "for example --entries 256"});
  }
  if (!arguments.head || (arguments.kind.empty() && !arguments.entries && arguments.common.json.empty())) return;
  throw_usage({.where = "--head",
               .what = "covers all kinds and prints text only",
               .expected = "--head alone",
               .got = "--kind, --entries or --json as well",
               .fix = "leave them out"});
}

std::string head_section(const FamilyArguments& arguments) {
  const auto head = analysis::head_scene();
  ProgressBar bar("head", watching(arguments.common));
  return analysis::head_section(
      head, analysis::head_table(head, analysis::whole_head(), arguments.common.threads, bar.callback()));
}

ExitCode run(const FamilyArguments& arguments) {
  const Output output(arguments.common);
  check(arguments);
  check_outputs({.others = {arguments.common.json}});
  if (arguments.head) {
    output.line(head_section(arguments));
    return ExitCode::Pass;
  }
  auto range = analysis::whole_family();
  range.timed = true;
  if (!arguments.kind.empty()) range.kinds = {analysis::kind_of(arguments.kind)};
  if (arguments.entries) range.entries = {*arguments.entries};
  const auto cells = analysis::family_table(range);
  output.line(analysis::family_text(cells));
  output.json(
      {{"verb", "family"}, {"version", program_version()}, {"unit", "1/255 of the mean"}, {"cells", to_json(cells)}});
  output.note_time("measured");
  return ExitCode::Pass;
}

void declare(Options& options, FamilyArguments& to) {
  options.group("What");
  options.choice("--kind", to.kind, index_kinds(), "KIND", "one kind of index only, a value of index.kind");
  options.integer("--entries", to.entries, 2, 65536, "N",
                  "entries of the radial table, a power of two (default 64 to 2048)");
  options.flag("--head", to.head, "compare every kind's picture of the head scan with golden's instead; takes minutes");
  declare(options, to.common);
  options.example("fastsplat family --kind rlut --entries 1024",
                  "weights, bits, operations and cycles of one kind of index");
  options.example("fastsplat family --json family.json", "all kinds as JSON", Example::Slow);
}

}  // namespace

const Subcommand subcommands::family{"family", "compare all kinds of index: error of weights, bits, operations, cycles",
                                     subcommand<FamilyArguments, declare, run>};

}  // namespace fastsplat::cli
