// SPDX-License-Identifier: Apache-2.0
// fastsplat errors propose: the cheapest configuration that meets a target on all given scenes.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/errors/propose.hpp"
#include "base/atomic_file.hpp"
#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_list.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

struct ErrorsProposeArguments {
  Common common;
  SceneList scenes;
  std::string target, from = "base", out, journal;
};

/// "proposed-psnr50": from the target's letters and digits.
std::string name_of(const analysis::Target& target) {
  std::string name = "proposed-";
  for (const char c : target.text) {
    if (c != '<' && c != '>' && c != '=') name += c;
  }
  return name;
}

ExitCode run(const ErrorsProposeArguments& arguments) {
  const Output output(arguments.common);
  const analysis::Target target = analysis::parse_target(arguments.target);
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
    proposal = analysis::propose(scenes, names, from, target, journal, arguments.common.threads, bar.callback());
  }
  cmodel::Config& best = proposal.search.best;
  best.name = name_of(target);
  best.description = fmt::format("{} on {}, from {}.", target.text, fmt::join(names, "; "), from.name);
  best.verified = "nothing";
  if (proposal.search.met && !arguments.out.empty()) write_text_file(arguments.out, driver::to_toml(best));
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  output.line(text + analysis::to_text(proposal));
  nlohmann::ordered_json json{{"verb", "errors propose"}, {"version", program_version()}};
  json.update(analysis::to_json(proposal));
  output.json(json);
  output.note_time("searched");
  return proposal.search.met ? ExitCode::Pass : ExitCode::Failed;
}

void declare(Options& options, ErrorsProposeArguments& to) {
  declare(options, to.scenes);
  options.group("Search");
  options.required("--target", to.target, "TARGET",
                   "target psnr>=DB, max<=LSB or rms<=LSB against golden, in 8-bit LSB over colours and alpha");
  options.word("--from", to.from, "NAME|FILE", "configuration to start from, which sets all other keys (base)");
  options.values(driver::config_names);
  options.word("--journal", to.journal, "FILE", "results of tried configurations, reused by later runs; JSON lines");
  options.group("Output");
  options.word("-o,--out", to.out, "FILE", "write the configuration, .toml, if the target is met");
  declare(options, to.common);
  options.example("fastsplat errors propose --target 'psnr>=50' --volume shells:24 --size 48 -o enough.toml",
                  "the cheapest configuration with 50 dB");
  options.example(
      "fastsplat errors propose --target 'max<=1' --scenes demo:layer-adding,demo:overlap-adding --from small "
      "--journal tried.jsonl",
      "over several scenes, resumable later", Example::Slow);
}

}  // namespace

const Subcommand subcommands::errors_propose{"errors propose", "find the cheapest configuration that meets a target",
                                             subcommand<ErrorsProposeArguments, declare, run>};

}  // namespace fastsplat::cli
