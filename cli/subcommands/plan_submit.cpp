// SPDX-License-Identifier: Apache-2.0
// fastsplat plan submit: submits a plan to a cluster, its shards as tasks of job arrays, followed by a merge.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "analysis/sweep/lost_tasks.hpp"
#include "analysis/sweep/script_engines.hpp"
#include "analysis/sweep/slurm_client.hpp"
#include "analysis/sweep/slurm_script.hpp"
#include "base/atomic_file.hpp"
#include "base/programs.hpp"
#include "base/shell_word.hpp"
#include "base/version.hpp"
#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/plan_arguments.hpp"
#include "cli/plan_vocabulary.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostTasks = 1000;      ///< per submission, unless --shards is given
constexpr std::size_t kUsualArrayMax = 1001;  ///< Slurm's default, for a dry run without scontrol

struct PlanSubmitArguments {
  Common common;
  PlanFlags plan;
  std::string engine;
  std::optional<std::string> out, partition, time;
  std::optional<std::size_t> shards, array_max;
  std::size_t at_once = 0;
  int jobs = 1;
  std::vector<std::string> directives;
  bool dry_run = false, lost = false;

  bool slurm() const { return engine == "slurm"; }
};

/// The submission, real or as a dry run.
struct PlanSubmitResult {
  plan::Submission submission;
  std::vector<plan::JobArray> arrays;
  std::vector<plan::ScriptFile> files;
  std::vector<std::string> jobs;  ///< of the arrays; empty in a dry run
  std::string merge_job;
  std::size_t cases = 0, done = 0;
  std::string plan_name, plan_hash;
};

[[noreturn]] void no_slurm(const std::string& program) {
  throw_input(
      {.where = "--engine slurm",
       .what = program + " is not installed",
       .expected = {},
       .got = {},
       .fix = "submit on a machine of the cluster, or use --engine script; --dry-run prints what would be sent"});
}

/// Directives become single lines of a script: refuses those with line ends or without a dash.
void check(const PlanSubmitArguments& arguments) {
  if (arguments.engine.empty()) {
    throw_usage({.where = "--engine",
                 .what = "is missing",
                 .expected = "slurm or script",
                 .got = {},
                 .fix = "add --engine slurm for sbatch, or --engine script for LSF, SGE and GNU parallel"});
  }
  if (arguments.time) plan::seconds_from(*arguments.time);
  for (const auto& directive : arguments.directives) {
    if (directive.starts_with("-") && directive.find_first_of("\n\r") == std::string::npos) continue;
    throw_usage({.where = "--sbatch",
                 .what = "not an option of sbatch",
                 .expected = "a word that starts with a dash",
                 .got = directive,
                 .fix = "for example --sbatch=--account=chips"});
  }
  const std::string partition = arguments.partition.value_or("");
  if (partition.find_first_of(" \t\n\r\"'\\") != std::string::npos || partition.starts_with("-"))
    throw_usage({.where = "--partition",
                 .what = "invalid partition name",
                 .expected = {},
                 .got = partition,
                 .fix = "run sinfo for the list of partitions"});
  if (!arguments.slurm() && !arguments.directives.empty())
    throw_usage(
        {.where = "--sbatch", .what = "applies to Slurm only", .expected = {}, .got = {}, .fix = "add --engine slurm"});
}

std::string merged_name(const PlanSubmitArguments& arguments) {
  return arguments.out.value_or(fs::path(arguments.plan.plan).replace_extension(".merged.json").string());
}

std::size_t array_max(const PlanSubmitArguments& arguments) {
  if (arguments.array_max) return *arguments.array_max;
  if (!arguments.slurm()) return 1000;  // LSF's usual limit, smaller than SGE's
  // --lost may run in the merge job on a machine without Slurm clients, and a dry run anywhere.
  if ((arguments.dry_run || arguments.lost) && !in_path("scontrol")) return kUsualArrayMax;
  return plan::slurm_array_max();
}

plan::Submission describe(const PlanSubmitArguments& arguments, const plan::Plan& plan) {
  const auto whole = [](const std::string& path) { return fs::weakly_canonical(fs::absolute(path)); };
  plan::Submission submission{.name = {},
                              .what = fmt::format("plan {}, {}", plan.name, counted(plan.cases.size(), "case")),
                              .program = fs::read_symlink("/proc/self/exe"),
                              .plan = whole(arguments.plan.plan),
                              .results = whole(arguments.plan.folder()),
                              .merged = whole(merged_name(arguments)),
                              .folder = fs::current_path(),
                              .shards = std::min(arguments.shards.value_or(kMostTasks), plan.cases.size()),
                              .array_max = array_max(arguments),
                              .jobs = arguments.jobs,
                              .threads = std::max(1, arguments.common.threads),
                              .partition = arguments.partition.value_or(""),
                              .time = arguments.time.value_or(""),
                              .at_once = arguments.at_once,
                              .directives = arguments.directives};
  submission.name = plan::job_name(plan.name, plan.hash, submission.results);
  return submission;
}

void write_files(const PlanSubmitResult& result) {
  std::error_code error;
  fs::create_directories(result.submission.logs(), error);
  if (error) {
    throw_input({.where = result.submission.logs().string(),
                 .what = "cannot create the folder: " + error.message(),
                 .expected = {},
                 .got = {},
                 .fix = "use --results with a writable folder that all machines share"});
  }
  for (const auto& file : result.files) write_text_file(file.path, file.text);
}

/// Submits everything or nothing: if sbatch fails, cancels the arrays already queued.
void send(PlanSubmitResult& result) {
  const auto& s = result.submission;
  const std::string names = s.name + "," + s.merge_name();
  if (const auto queued = plan::slurm_queued(names); !queued.empty()) {
    throw_input({.where = s.results.string(),
                 .what = "this plan is already queued for this folder",
                 .expected = {},
                 .got = "job " + queued,
                 .fix = "wait for it, or cancel it first: scancel --name=" + names});
  }
  try {
    for (const auto& array : result.arrays) result.jobs.push_back(plan::slurm_submit(plan::sbatch_array(s, array)));
    result.merge_job = plan::slurm_submit(plan::sbatch_merge(s, result.jobs));
  } catch (const UserError&) {
    plan::slurm_cancel(result.jobs);
    throw;
  }
}

/// A dry run has placeholders instead of numbers.
std::vector<std::string> job_numbers(const PlanSubmitResult& result) {
  if (!result.jobs.empty()) return result.jobs;
  std::vector<std::string> names;
  for (const auto& array : result.arrays) names.push_back(fmt::format("JOB{}", array.number));
  return names;
}

std::string head(const PlanSubmitResult& result) {
  const auto& s = result.submission;
  return fmt::format("{}: {} of {} to do, in {} of {}\n", result.plan_name, result.cases - result.done,
                     counted(result.cases, "case"), s.to_do.size(), counted(s.shards, "task"));
}

std::string to_text(const PlanSubmitResult& result, const PlanSubmitArguments& arguments) {
  const auto& s = result.submission;
  std::string text = head(result);
  if (arguments.dry_run) {
    for (const auto& file : result.files) text += fmt::format("\n--- {}\n{}", file.path.string(), file.text);
    text += "\n";
  }
  if (!arguments.slurm()) return text + plan::engine_recipes(s);
  const auto numbers = job_numbers(result);
  if (arguments.dry_run) {
    text += "--- submitted with\n";
    for (const auto& array : result.arrays) text += plan::shell_line(plan::sbatch_array(s, array)) + "\n";
    return text + plan::shell_line(plan::sbatch_merge(s, numbers)) + "\n";
  }
  for (std::size_t i = 0; i < result.arrays.size(); ++i) {
    text += fmt::format("job {}: {}, {}\n", numbers[i], counted(result.arrays[i].tasks.size(), "task"),
                        plan::slurm_array_path(s, result.arrays[i]).string());
  }
  return text + fmt::format("job {}: merges into {}{}\n", result.merge_job, s.merged.string(),
                            result.arrays.empty() ? "" : " after the arrays end");
}

Json to_json(const PlanSubmitResult& result, const PlanSubmitArguments& arguments) {
  const auto& s = result.submission;
  const auto or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  Json json{{"verb", "plan submit"},
            {"version", program_version()},
            {"plan", {{"name", result.plan_name}, {"hash", result.plan_hash}}},
            {"engine", arguments.engine},
            {"dry_run", arguments.dry_run},
            {"cases", result.cases},
            {"done", result.done},
            {"shards", s.shards},
            {"array_max", s.array_max},
            {"results", s.results.string()},
            {"merged", s.merged.string()},
            {"name", s.name},
            {"arrays", Json::array()}};
  for (std::size_t i = 0; i < result.arrays.size(); ++i) {
    const auto& array = result.arrays[i];
    json["arrays"].push_back({{"first_shard", array.first},
                              {"tasks", plan::index_ranges(array.tasks)},
                              {"job", i < result.jobs.size() ? Json(result.jobs[i]) : Json()}});
  }
  json["merge_job"] = or_null(result.merge_job);
  json["files"] = Json::array();
  for (const auto& file : result.files) json["files"].push_back(file.path.string());
  return json;
}

/// Lists the tasks whose results are missing, and their logs.
ExitCode print_lost(const Output& output, const plan::Plan& plan, const plan::Submission& submission) {
  const auto lost = plan::lost_tasks(plan, submission, plan::cases_to_do(plan, submission.results, program_hash()));
  std::string text;
  Json tasks = Json::array();
  for (const auto& task : lost) {
    text += fmt::format("shard {} of {} has no result for {}: {}; {}\n", task.shard, submission.shards,
                        counted(task.cases.size(), "case"), fmt::join(task.cases, ", "),
                        task.log.empty() ? "it never started" : "see " + task.log.string());
    tasks.push_back({{"shard", task.shard}, {"cases", task.cases}, {"log", task.log.string()}});
  }
  output.line(text.empty() ? "no results are missing\n" : text + "submit again: only these are submitted\n");
  output.json({{"verb", "plan submit"}, {"version", program_version()}, {"lost", tasks}});
  return lost.empty() ? ExitCode::Pass : ExitCode::Failed;
}

ExitCode run(const PlanSubmitArguments& arguments) {
  const Output output(arguments.common);
  check(arguments);
  const bool writes = !arguments.dry_run && !arguments.lost;
  check_outputs({.others = {writes ? merged_name(arguments) : std::string(), arguments.common.json},
                 .inputs = {arguments.plan.plan}});
  const auto plan = plan::read_plan(arguments.plan.plan);
  if (arguments.slurm() && writes) {
    for (const char* client : {"sbatch", "scontrol", "squeue", "scancel"})
      if (!in_path(client)) no_slurm(client);
  }
  PlanSubmitResult result{.submission = describe(arguments, plan),
                          .arrays = {},
                          .files = {},
                          .jobs = {},
                          .merge_job = {},
                          .cases = plan.cases.size(),
                          .plan_name = plan.name,
                          .plan_hash = plan.hash};
  if (arguments.lost) return print_lost(output, plan, result.submission);
  require_content(plan, arguments.plan.plan);
  auto& s = result.submission;
  const auto to_do = plan::cases_to_do(plan, s.results, program_hash());
  result.done = result.cases - to_do.size();
  s.to_do = plan::shards_of(to_do, s.shards);
  result.arrays = plan::arrays_of(s);
  result.files = arguments.slurm() ? plan::slurm_scripts(s) : plan::engine_scripts(s);
  if (!arguments.dry_run) {
    write_files(result);
    if (arguments.slurm()) send(result);
  }
  output.line(to_text(result, arguments));
  output.json(to_json(result, arguments));
  return ExitCode::Pass;
}

void declare(Options& options, PlanSubmitArguments& to) {
  declare(options, to.plan);
  options.word("-o,--out", to.out, "FILE", "file of the merged rows (for PLAN.json: PLAN.merged.json)");
  options.group("Cluster");
  options.choice("--engine", to.engine, {"slurm", "script"}, "ENGINE",
                 "slurm: submit job arrays and a merge; script: write arrays for LSF and SGE and a command list");
  options.word("--partition", to.partition, "NAME", "partition or queue (default: the site's)");
  options.word("--time", to.time, "TIME", "time limit of a task: minutes, h:mm:ss or days-hours (default: the site's)");
  options.integer("--shards", to.shards, 1, 1000000, "N",
                  "total number of tasks (default: one per case, at most 1000)");
  options.integer("--array-max", to.array_max, 1, 10000000, "N",
                  "maximum tasks of an array (default: scontrol's limit, 1000 for script)");
  options.integer("--at-once", to.at_once, 1, 1000000, "N",
                  "maximum tasks of an array at the same time (default: all)");
  options.integer("--jobs", to.jobs, 1, 1024, "N", "cases at once in a task, which requests as many processors (1)");
  options.words("--sbatch", to.directives, "OPTION",
                "option passed to sbatch, for example --sbatch=--account=chips; repeatable");
  options.flag("--dry-run", to.dry_run, "print scripts and commands without writing or submitting them");
  options.flag("--lost", to.lost, "list tasks without a result and submit nothing; use the same --shards as before");
  declare(options, to.common);
  options.example("fastsplat plan submit plan.json --engine slurm --partition short --array-max 1000 --dry-run",
                  "print what would be submitted to Slurm");
  options.example("fastsplat plan submit plan.json --engine script --shards 4 --dry-run",
                  "print scripts for LSF and SGE and a command list for GNU parallel");
}

}  // namespace

const Subcommand subcommands::plan_submit{"plan submit", "submit a plan to a cluster: Slurm, LSF, SGE, GNU parallel",
                                          subcommand<PlanSubmitArguments, declare, run>};

}  // namespace fastsplat::cli
