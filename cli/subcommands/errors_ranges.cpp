// SPDX-License-Identifier: Apache-2.0
// fastsplat errors ranges: the value ranges at each narrowing site and the effect of other formats.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/errors/ranges.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_list.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"

namespace fastsplat::cli {
namespace {

struct ErrorsRangesArguments {
  Common common;
  SceneList scenes;
  ConfigFlags config;
};

ExitCode run(const ErrorsRangesArguments& arguments) {
  const Output output(arguments.common);
  const cmodel::Config config = load(arguments.config);
  const auto flags = scenes_of(arguments.scenes);
  check_outputs(
      {.others = {arguments.common.json},
       .inputs = joined(inputs_of(arguments.scenes), inputs_of_config(arguments.config.config.value_or("")))});
  cmodel::Ranges all, wide;
  cmodel::Counters counters;
  std::vector<driver::DriverReport> reports;
  std::vector<std::string> names;
  ProgressBar bar("ranges", watching(arguments.common));
  const driver::RenderOptions options{.threads = arguments.common.threads, .progress = bar.callback()};
  for (const SceneFlags& each : flags) {
    const scene::Scene scene = build(each);
    output.remark(remarks(scene));
    names.push_back(summary(scene));
    driver::FrameRanges frame = driver::frame_ranges(scene, config, options);
    all += frame.ranges;
    counters += frame.counters;
    reports.push_back(frame.report);
    if (analysis::cut(frame.ranges)) frame = driver::frame_ranges(scene, analysis::roomy(config), options);
    wide += frame.ranges;
  }
  analysis::RangesReport report = analysis::ranges_report(config, all, wide);
  report.counters = counters;
  report.scenes = std::move(reports);
  report.names = std::move(names);
  std::string text;
  for (const std::string& name : report.names) text += name + "\n";
  text += fmt::format("configuration {} {}\n", config.name, hash_text(cmodel::config_hash(config)));
  output.line(text + analysis::to_text(report));
  nlohmann::ordered_json json{{"verb", "errors ranges"}, {"version", program_version()}};
  json.update(analysis::to_json(report));
  output.json(json);
  output.note_time("watched");
  return ExitCode::Pass;
}

void declare(Options& options, ErrorsRangesArguments& to) {
  declare(options, to.scenes);
  options.group("Device");
  declare(options, to.config, "hardware configuration, a name or a TOML file");
  options.group("Output");
  declare(options, to.common);
  options.example("fastsplat errors ranges --volume shells:32 --size 64 --config base",
                  "each signal's range and the bits it needs");
  options.example("fastsplat errors ranges --scenes demo:layer-adding,demo:overlap-adding --size 48 --config base",
                  "ranges over several scenes together");
}

}  // namespace

const Subcommand subcommands::errors_ranges{"errors ranges", "measure each signal's range and the format it needs",
                                            subcommand<ErrorsRangesArguments, declare, run>};

}  // namespace fastsplat::cli
