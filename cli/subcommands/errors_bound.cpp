// SPDX-License-Identifier: Apache-2.0
// fastsplat errors bound: a proved bound of every pixel's error, beside the error itself.
#include <nlohmann/json.hpp>

#include "analysis/compare.hpp"
#include "analysis/errors/attribution_report.hpp"
#include "analysis/errors/bound_report.hpp"
#include "cli/errors_output.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/staged_scene.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct ErrorsBoundArguments {
  Common common;
  StagedFlags of;
  int lsb_bits = 8;
  std::string maps;  ///< prefix, empty for none
};

struct ErrorsBoundResult {
  std::string scene;  ///< its summary
  cmodel::Config config;
  analysis::BoundReport report;
};

nlohmann::ordered_json to_json(const ErrorsBoundResult& result) {
  auto json = errors_identity("errors bound", result.scene, result.config);
  json.update(analysis::to_json(result.report));
  return json;
}

std::vector<std::string> map_names(const std::string& prefix, const char* ending) {
  std::vector<std::string> names;
  for (const analysis::Known known : analysis::kLevels) {
    if (!prefix.empty()) names.push_back(prefix + "." + analysis::to_string(known) + ending);
  }
  return names;
}

void write_maps(const ErrorsBoundArguments& arguments, const StagedScene& scene, const ErrorsBoundResult& result) {
  const Image real = analysis::to_image(result.report.real);
  for (const analysis::BoundResult& level : result.report.levels) {
    const std::string name = arguments.maps + "." + analysis::to_string(level.known);
    const Image most = analysis::to_image(level.bound.greatest);
    Image above = real;
    for (std::size_t v = 0; v < above.data.size(); ++v) above.data[v] += most.data[v];
    write_map(name + ".png", analysis::heat_map(real, above, {.lsb_bits = arguments.lsb_bits}));
    images::write_image(name + ".exr", most, scene.metadata("bound"));
  }
}

ExitCode run(const ErrorsBoundArguments& arguments) {
  const Output output(arguments.common);
  StagedScene scene(arguments.of);
  const cmodel::Config& config = scene.config();
  check_outputs({.images = map_names(arguments.maps, ".exr"),
                 .maps = map_names(arguments.maps, ".png"),
                 .raws = {},
                 .others = {arguments.common.json},
                 .inputs = scene.inputs()});
  scene.read(output);
  ErrorsBoundResult result{.scene = scene.summary(), .config = config, .report = {}};
  {
    const auto chain = scene.chain(arguments.common.threads, output);
    ProgressBar bar("bound", watching(arguments.common));
    result.report = analysis::bounds(*chain, arguments.common.threads, bar.callback());
  }
  if (!arguments.maps.empty()) write_maps(arguments, scene, result);
  output.line(errors_heading(result.scene, config) + analysis::to_text(result.report, arguments.lsb_bits));
  output.json(to_json(result));
  output.note_time("bounded");
  return result.report.holds() ? ExitCode::Pass : ExitCode::Failed;
}

void declare(Options& options, ErrorsBoundArguments& to) {
  declare(options, to.of);
  options.group("Output");
  options.integer("--lsb-bits", to.lsb_bits, 1, 24, "N", "one LSB is 1/(2^N - 1)");
  options.word("--maps", to.maps, "PREFIX",
               "write the bound of every pixel: PREFIX.LEVEL.png with legend, PREFIX.LEVEL.exr with values");
  declare(options, to.common);
  options.example("fastsplat errors bound --volume shells:32 --size 64 --config base --maps bound",
                  "a proved worst case for every pixel, as maps");
  options.example("fastsplat errors bound --volume shells:16 --size 32 --config tiny --json bound.json",
                  "as JSON; exit 1 if it does not hold");
  options.example("fastsplat errors bound --gaussians shells:500 --size 96", "the same of 3-D Gaussians");
}

}  // namespace

const Subcommand subcommands::errors_bound{"errors bound",
                                           "prove a worst case of every pixel's error (exit 1 if it does not hold)",
                                           subcommand<ErrorsBoundArguments, declare, run>};

}  // namespace fastsplat::cli
