// SPDX-License-Identifier: Apache-2.0
// fastsplat plan status: how far a plan has come.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/sweep/status.hpp"
#include "base/version.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/plan_arguments.hpp"
#include "cli/plan_vocabulary.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct PlanStatusArguments {
  Common common;
  PlanFlags plan;
  int shards = 0;
};

using Json = nlohmann::ordered_json;

constexpr std::size_t kShown = 10;

std::string row(const std::string& name, const plan::Count& count) {
  return fmt::format("{:<10}{:>8}{:>8}{:>8}{:>8}{:>8}{:>9}{:>11.1f}\n", name, count.cases, count.passed, count.failed,
                     count.errors, count.again, count.missing, count.cpu_seconds);
}

std::string to_text(const plan::PlanStatus& status) {
  std::string text = fmt::format("{:<10}{:>8}{:>8}{:>8}{:>8}{:>8}{:>9}{:>11}\n", "", "cases", "passed", "failed",
                                 "errors", "again", "missing", "CPU [s]");
  for (std::size_t at = 0; at < status.shards.size(); ++at)
    text += row(fmt::format("{}/{}", at + 1, status.shards.size()), status.shards[at]);
  text += row("all", status.all);
  const auto& all = status.all;
  if (const auto left = all.missing + all.again; left > 0 && all.timed > 0) {
    text += fmt::format("left: {}, about {:.0f} s of CPU time\n", counted(left, "case"),
                        all.cpu_seconds / static_cast<double>(all.timed) * static_cast<double>(left));
  }
  for (std::size_t at = 0; at < std::min(kShown, status.troubles.size()); ++at) text += status.troubles[at] + "\n";
  if (status.troubles.size() > kShown) text += fmt::format("... and {} more\n", status.troubles.size() - kShown);
  return text;
}

Json to_json(const plan::Count& count) {
  return {
      {"cases", count.cases}, {"passed", count.passed},   {"failed", count.failed},          {"errors", count.errors},
      {"again", count.again}, {"missing", count.missing}, {"cpu_seconds", count.cpu_seconds}};
}

Json to_json(const plan::PlanStatus& status) {
  Json json{
      {"verb", "plan status"}, {"version", program_version()}, {"all", to_json(status.all)}, {"shards", Json::array()}};
  for (const auto& shard : status.shards) json["shards"].push_back(to_json(shard));
  json["troubles"] = status.troubles;
  return json;
}

ExitCode run(const PlanStatusArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}, .inputs = {arguments.plan.plan}});
  const auto status = plan::status_of(plan::read_plan(arguments.plan.plan), arguments.plan.folder(), program_hash(),
                                      static_cast<std::size_t>(arguments.shards));
  output.line(to_text(status));
  output.json(to_json(status));
  return ExitCode::Pass;
}

void declare(Options& options, PlanStatusArguments& to) {
  declare(options, to.plan);
  options.integer("--shards", to.shards, 0, 100'000, "N", "count by shard, as divided by `plan run --shard I/N`");
  declare(options, to.common);
  options.example("fastsplat plan status plan.json", "how many cases are done, failed and open");
  options.example("fastsplat plan status plan.json --shards 4", "the same by shard");
}

}  // namespace

const Subcommand subcommands::plan_status{"plan status", "count done, failed and missing cases of a plan",
                                          subcommand<PlanStatusArguments, declare, run>};

}  // namespace fastsplat::cli
