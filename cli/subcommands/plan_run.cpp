// SPDX-License-Identifier: Apache-2.0
// fastsplat plan run: runs the remaining cases of a plan or a shard; can be killed at any time and resumes.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "analysis/sweep/run.hpp"
#include "base/version.hpp"
#include "cli/command_line.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/plan_arguments.hpp"
#include "cli/plan_vocabulary.hpp"
#include "cli/progress_bar.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "scene/kept_volumes.hpp"

namespace fastsplat::cli {
namespace {

struct PlanRunArguments {
  Common common;
  PlanFlags plan;
  std::string shard = "1/1";
  int jobs = 0;
  bool retry = false, again = false;
};

using Json = nlohmann::ordered_json;

std::string to_text(const plan::RunSummary& summary, const std::string& folder) {
  const auto done = summary.passed + summary.failed + summary.errors;
  const std::string left = summary.accidents == 0 ? std::string()
                                                  : fmt::format("{} without a result: run the plan again\n",
                                                                counted(summary.accidents, "case"));
  return fmt::format("{} of {} done in {}: {} passed, {} failed, {} with errors; {} were done before\n{}", done,
                     counted(summary.cases, "case"), folder, summary.passed, summary.failed, summary.errors,
                     summary.skipped, left);
}

Json to_json(const plan::RunSummary& summary, const PlanRunArguments& arguments, double seconds) {
  return {{"verb", "plan run"},       {"version", program_version()},       {"shard", arguments.shard},
          {"cases", summary.cases},   {"skipped", summary.skipped},         {"passed", summary.passed},
          {"failed", summary.failed}, {"errors", summary.errors},           {"accidents", summary.accidents},
          {"signal", summary.signal}, {"cpu_seconds", summary.cpu_seconds}, {"seconds", seconds}};
}

ExitCode exit_code(const plan::RunSummary& summary) {
  if (summary.signal != 0) return static_cast<ExitCode>(128 + summary.signal);
  if (summary.accidents > 0) return ExitCode::Input;
  return summary.failed + summary.errors > 0 ? ExitCode::Failed : ExitCode::Pass;
}

/// The program in a fork of this process: files that it would read or compute are in memory if they were kept.
int call(const plan::Words& words) {
  std::vector<const char*> argv{"fastsplat"};
  for (const auto& word : words) argv.push_back(word.c_str());
  return run_program(static_cast<int>(argv.size()), argv.data());
}

/// Keeps volumes while several cases of the shard need them.
class SharedVolumes {
 public:
  SharedVolumes(const plan::Plan& plan, const plan::Shard& shard) {
    for (std::size_t at = 0; at < plan.cases.size(); ++at) {
      if (shard.has(at)) ++left_[of(plan.cases[at])];
    }
  }

  /// To be called after each case.
  void done(const plan::Case& one) {
    const plan::Settings volume = of(one);
    if (volume.empty()) return;
    const std::size_t left = --left_[volume];
    try {
      if (left >= 4) scene::keep_volume(scene_of(one.settings));
      if (left == 0) scene::forget_volume(scene_of(one.settings));
    } catch (const std::exception&) {
      // It is not kept. A child reports what is wrong.
    }
  }

 private:
  /// What names the volume; empty if nothing does.
  static plan::Settings of(const plan::Case& one) {
    plan::Settings out;
    for (const plan::Setting& setting : one.settings) {
      if (setting.name == "volume" || setting.name == "scene" || setting.name == "nan-as") out.push_back(setting);
    }
    return out;
  }

  std::map<plan::Settings, std::size_t> left_;
};

ExitCode run(const PlanRunArguments& arguments) {
  const Output output(arguments.common);
  const plan::Shard shard = plan::shard_from(arguments.shard);
  check_outputs({.others = {arguments.common.json}, .inputs = {arguments.plan.plan}});
  const auto plan = plan::read_plan(arguments.plan.plan);
  require_content(plan, arguments.plan.plan);
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int jobs = arguments.jobs > 0 ? arguments.jobs : processors;
  const int threads = arguments.common.threads > 0 ? arguments.common.threads : std::max(1, processors / jobs);
  SharedVolumes shared(plan, shard);
  ProgressBar bar("plan", watching(arguments.common));
  const auto summary = plan::run(
      plan, {.results = arguments.plan.folder(),
             .program = call,
             .program_hash = program_hash(),
             .shard = shard,
             .jobs = static_cast<std::size_t>(jobs),
             .threads = threads,
             .retry_failed = arguments.retry,
             .replace_foreign = arguments.again,
             .progress = bar.callback(),
             .finished =
                 [&](const plan::Case& one, const plan::CaseResult& result) {
                   if (result.status == plan::Status::Pass) return;
                   bar.erase();
                   output.warn(fmt::format("case {}: {}\n  {}", one.id, result.message, plan::command_of(one)));
                 },
             .changed =
                 [] {
                   const std::string file = changed_file();
                   return file.empty() ? "" : file + ": changed while the plan ran; restore it or make the plan again";
                 },
             .unharmed = [&](const plan::Case& one) { shared.done(one); },
             .accident =
                 [&](const plan::Case& one, const std::string& message) {
                   bar.erase();
                   output.warn(fmt::format("case {} has no result and will be run again next time: {}\n  {}", one.id,
                                           message, plan::command_of(one)));
                 },
             .note = [&](const std::string& text) { output.note(text); }});
  bar.erase();
  output.line(to_text(summary, arguments.plan.folder()));
  output.json(to_json(summary, arguments, output.seconds()));
  if (summary.signal != 0) output.note("stopped by a signal: results are kept; run the plan again to continue");
  return exit_code(summary);
}

void declare(Options& options, PlanRunArguments& to) {
  declare(options, to.plan);
  options.flag("--retry", to.retry, "also run failed cases again");
  options.flag("--again", to.again, "replace results of another program or other content");
  options.group("Work");
  options.word("--shard", to.shard, "I/N", "only every N-th case, starting with the I-th (I from 1 to N)");
  options.integer("--jobs", to.jobs, 0, 1024, "N", "cases at once; 0: the number of processors");
  declare(options, to.common);
  options.example("fastsplat plan run plan.json --jobs 2",
                  "run all open cases, two at once; an interrupted run can be continued");
  options.example("fastsplat plan run plan.json --shard 1/4 --results results",
                  "run a quarter of the cases, on one of four machines");
}

}  // namespace

const Subcommand subcommands::plan_run{"plan run", "run the open cases of a plan",
                                       subcommand<PlanRunArguments, declare, run>};

}  // namespace fastsplat::cli
