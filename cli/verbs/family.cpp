// fastsplat family: every kind of index, what it costs and what it gets wrong.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/family/family_page.hpp"
#include "base/hash_text.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/verbs/verbs.hpp"

namespace fastsplat::cli {
namespace {

struct Arguments {
  Common common;
  std::string kind;
  std::optional<int> entries;
  bool page = false;
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

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}});
  if (arguments.page) {
    if (!arguments.common.json.empty() || !arguments.kind.empty() || arguments.entries) {
      throw_usage({.where = "--page",
                   .what = "is the whole page, as text",
                   .expected = {},
                   .got = {},
                   .fix = "leave out --kind, --entries and --json"});
    }
    output.line(analysis::family_page());
    return ExitCode::Pass;
  }
  auto range = analysis::whole_family();
  range.timed = true;
  if (!arguments.kind.empty()) range.kinds = {analysis::kind_of(arguments.kind)};
  if (arguments.entries) range.entries = {*arguments.entries};
  const auto cells = analysis::family_table(range);
  output.line(analysis::family_text(cells));
  output.json({{"verb", "family"}, {"unit", "1/255 of the mean"}, {"cells", to_json(cells)}});
  output.note_time("measured");
  return ExitCode::Pass;
}

void declare(Options& options, Arguments& to) {
  options.group("What");
  options.word("--kind", to.kind, "KIND",
               "one kind of index only: linear, squared, squared_elliptic, blit2d, rlut, separable");
  options.integer("--entries", to.entries, 2, 65536, "N", "of the radial table, a power of two; else 64 to 2048");
  options.flag("--page", to.page, "docs/family.md, which has nothing that depends on the machine");
  declare(options, to.common);
  options.example("fastsplat family --kind rlut --entries 1024");
}

}  // namespace

const Verb verbs::family{"family", "every kind of index: weights against the exact ones, bits, operations, cycles",
                         verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
