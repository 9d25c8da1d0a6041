// SPDX-License-Identifier: Apache-2.0
// fastsplat errors propose: the cheapest configuration that meets a target on all given scenes.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/errors/propose.hpp"
#include "base/atomic_file.hpp"
#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/frame_scaling.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_list.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

struct ErrorsProposeArguments {
  Common common;
  SceneList scenes;
  std::vector<std::string> targets;
  std::optional<double> clock;  ///< MHz
  std::string from = "base", out, journal;
};

/// "proposed-psnr50-fps60": from the targets' letters and digits.
std::string name_of(const analysis::Targets& targets) {
  std::string name = "proposed-";
  for (const char c : targets.text()) {
    if (c == ' ') name += '-';
    if (c != '<' && c != '>' && c != '=' && c != ',' && c != ' ') name += c;
  }
  return name;
}

void check_clock(const analysis::Targets& targets, const std::optional<double>& clock) {
  if (targets.fps.has_value() == clock.has_value()) return;
  throw_usage({.where = "--clock",
               .what = clock ? "is for a target of frames a second only" : "is needed to count frames a second",
               .expected = clock ? "--target 'fps>=RATE'" : "the devices' clock in MHz",
               .got = {},
               .fix = clock ? "add such a target, or leave --clock out" : "add --clock, such as --clock 200"});
}

ExitCode run(const ErrorsProposeArguments& arguments) {
  const Output output(arguments.common);
  const analysis::Targets targets = analysis::parse_targets(arguments.targets);
  check_clock(targets, arguments.clock);
  const cmodel::Config from = load(arguments.from, {});
  if (from.index() != cmodel::IndexKind::Rlut) {
    throw_usage({.where = "--from",
                 .what = "the cost model covers the RTL only, whose index is the RLUT",
                 .expected = "index.kind = rlut",
                 .got = cmodel::text_of(from, *cmodel::find_key("index.kind")),
                 .fix = "use `fastsplat family` to compare index kinds"});
  }
  if (from.interpolates()) {
    throw_usage({.where = "--from",
                 .what = "the noise model covers tables without interpolation only",
                 .expected = "radial.interpolate = 0",
                 .got = "1",
                 .fix = "start from a configuration without interpolation, such as base"});
  }
  if (targets.fps) {
    for (auto wrong : {cmodel::rtl_violation(from), cmodel::cycle_violation(from)}) {
      if (!wrong) continue;
      wrong->where = "configuration " + from.name + ": " + wrong->where;
      throw_usage(*wrong);
    }
  }
  const auto flags = scenes_of(arguments.scenes);
  check_outputs({.others = {arguments.out, arguments.journal, arguments.common.json},
                 .inputs = joined(inputs_of(arguments.scenes), inputs_of_config(arguments.from))});
  std::vector<scene::Scene> scenes;
  std::vector<std::string> names;
  for (const SceneFlags& each : flags) {
    scenes.push_back(build(each));
    output.remark(remarks(scenes.back()));
    names.push_back(summary(scenes.back()));
  }
  analysis::Journal journal(arguments.journal);
  analysis::Proposal proposal;
  {
    ProgressBar bar("configurations", watching(arguments.common));
    proposal = analysis::propose(scenes, names, from, targets, arguments.clock.value_or(0.0), journal,
                                 arguments.common.threads, bar.callback());
  }
  cmodel::Config& best = proposal.config;
  best.name = name_of(targets);
  best.description = fmt::format("{} on {}, from {}.", targets.text(), fmt::join(names, "; "), from.name);
  best.verified = "nothing";
  if (proposal.met() && !arguments.out.empty()) write_text_file(arguments.out, driver::to_toml(best));
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  output.line(text + analysis::to_text(proposal));
  nlohmann::ordered_json json{{"verb", "errors propose"}, {"version", program_version()}};
  json.update(analysis::to_json(proposal));
  output.json(json);
  output.note_time("searched");
  return proposal.met() ? ExitCode::Pass : ExitCode::Failed;
}

void declare(Options& options, ErrorsProposeArguments& to) {
  declare(options, to.scenes);
  options.group("Search");
  options.words(
      "--target", to.targets, "TARGET",
      "target psnr>=DB, max<=LSB or rms<=LSB against golden, in 8-bit LSB over colours and alpha, or fps>=RATE, "
      "frames per second; required; repeatable: all hold");
  declare_clock(options, to.clock, "clock of the devices, for fps>=RATE");
  options.word("--from", to.from, "NAME|FILE", "configuration to start from, which sets all other keys (base)");
  options.values(driver::config_names);
  options.word("--journal", to.journal, "FILE", "results of tried configurations, reused by later runs; JSON lines");
  options.group("Output");
  options.word("-o,--out", to.out, "FILE", "write the configuration, .toml, if the target is met");
  declare(options, to.common);
  options.example("fastsplat errors propose --target 'psnr>=50' --volume shells:24 --size 48 -o enough.toml",
                  "the cheapest configuration with 50 dB");
  options.example(
      "fastsplat errors propose --target 'psnr>=50' --target 'fps>=500' --clock 200 --volume shells:24 --size 48",
      "also how many devices with which array, tile and culling are fast enough, least area first", Example::Slow);
  options.example(
      "fastsplat errors propose --target 'max<=1' --scenes demo:layer-adding,demo:overlap-adding --from small "
      "--journal tried.jsonl",
      "over several scenes, resumable later", Example::Slow);
}

}  // namespace

const Subcommand subcommands::errors_propose{"errors propose", "find the cheapest configuration that meets a target",
                                             subcommand<ErrorsProposeArguments, declare, run>};

}  // namespace fastsplat::cli
