// SPDX-License-Identifier: Apache-2.0
// fastsplat errors: which steps cause the device picture's error.
#include <nlohmann/json.hpp>

#include "analysis/compare.hpp"
#include "analysis/errors/attribution_report.hpp"
#include "cli/errors_output.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/staged_scene.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct ErrorsArguments {
  Common common;
  StagedFlags of;
  int lsb_bits = 8;
  bool quick = false, shapley = false;
  std::optional<std::string> formats;
  bool tile_centres = false, flush_subnormals = false;
  std::string blame, maps;  ///< a file, and a prefix; empty for none
};

struct ErrorsResult {
  std::string scene;  ///< its summary
  cmodel::Config config;
  analysis::Attribution attribution;
  std::optional<analysis::TriedSuggestion> tried;
  std::string blame;  ///< the map's file; empty for none
};

nlohmann::ordered_json to_json(const ErrorsResult& result) {
  auto json = errors_identity("errors", result.scene, result.config);
  json.update(analysis::to_json(result.attribution, result.tried));
  if (!result.blame.empty()) json["blame"] = result.blame;
  return json;
}

/// Of --formats, "fp16" or "fp16,fp32".
std::optional<stages::FloatNumbers> floats_of(const ErrorsArguments& arguments) {
  if (!arguments.formats) {
    if (arguments.tile_centres || arguments.flush_subnormals)
      throw_usage({.where = arguments.tile_centres ? "--tile-centres" : "--flush-subnormals",
                   .what = "describes floats",
                   .expected = {},
                   .got = {},
                   .fix = "add --formats, or leave it out"});
    return std::nullopt;
  }
  const std::string& names = *arguments.formats;
  const auto comma = std::min(names.find(','), names.size());
  stages::FloatNumbers out{.subnormals = !arguments.flush_subnormals, .tile_centres = arguments.tile_centres};
  out.operands = stages::float_format(names.substr(0, comma), "--formats");
  out.sums = comma == names.size() ? out.operands : stages::float_format(names.substr(comma + 1), "--formats");
  return out;
}

/// "PREFIX.STEP.png" (or .exr) for the total error and each step.
std::vector<std::string> map_names(const std::string& prefix, const std::vector<stages::StepSet>& sets,
                                   const char* ending) {
  if (prefix.empty()) return {};
  std::vector<std::string> names{prefix + ".error" + ending};
  for (const stages::StepSet& set : sets) names.push_back(prefix + "." + analysis::file_word(set.name) + ending);
  return names;
}

void write_maps(const ErrorsArguments& arguments, const StagedScene& scene, const ErrorsResult& result) {
  const analysis::Attribution& a = result.attribution;
  const auto sets = scene.sets(a.floats.has_value());
  const auto pngs = map_names(arguments.maps, sets, ".png"), exrs = map_names(arguments.maps, sets, ".exr");
  const Image real = analysis::to_image(a.real);
  const images::Metadata metadata = scene.metadata("errors");
  const auto write = [&](std::size_t at, const stages::Picture& error) {
    const Image signed_error = analysis::to_image(error);
    Image test = real;
    for (std::size_t i = 0; i < test.data.size(); ++i) test.data[i] += signed_error.data[i];
    write_map(pngs[at], analysis::lsb_map(real, test, {.lsb_bits = arguments.lsb_bits}));
    images::write_image(exrs[at], signed_error, metadata);
  };
  write(0, analysis::difference(a.device, a.real));
  for (std::size_t k = 0; k < a.increments.size(); ++k) write(k + 1, a.increments[k]);
}

ExitCode run(const ErrorsArguments& arguments) {
  const Output output(arguments.common);
  StagedScene scene(arguments.of);
  const cmodel::Config& config = scene.config();
  const auto floats = floats_of(arguments);
  const auto sets = scene.sets(floats.has_value());
  check_outputs({.images = map_names(arguments.maps, sets, ".exr"),
                 .maps = joined(map_names(arguments.maps, sets, ".png"), {arguments.blame}),
                 .raws = {},
                 .others = {arguments.common.json},
                 .inputs = scene.inputs()});
  scene.read(output);
  ErrorsResult result{
      .scene = scene.summary(), .config = config, .attribution = {}, .tried = {}, .blame = arguments.blame};
  const int threads = arguments.common.threads;
  {
    const auto chain = scene.chain(threads, output);
    ProgressBar bar("errors", watching(arguments.common));
    result.attribution = analysis::attribute(*chain, {.quick = arguments.quick,
                                                      .floats = floats,
                                                      .shapley = arguments.shapley,
                                                      .threads = threads,
                                                      .progress = bar.callback()});
  }
  if (!floats)
    result.tried =
        analysis::try_suggestion([&](const cmodel::Config& other) { return scene.chain(other, threads); }, config,
                                 result.attribution, arguments.of.gaussians.file.has_value(), threads);
  if (!arguments.blame.empty()) write_map(arguments.blame, analysis::blame_map(result.attribution));
  if (!arguments.maps.empty()) write_maps(arguments, scene, result);
  output.line(errors_heading(result.scene, config) +
              analysis::to_text(result.attribution, result.tried, arguments.lsb_bits));
  output.json(to_json(result));
  output.note_time("attributed");
  return ExitCode::Pass;
}

void declare(Options& options, ErrorsArguments& to) {
  declare(options, to.of);
  options.group("Analysis");
  options.integer("--lsb-bits", to.lsb_bits, 1, 24, "N", "one LSB is 1/(2^N - 1)");
  options.flag("--quick", to.quick, "skip the runs with one step alone and with one left out: a third of the frames");
  options.flag("--shapley", to.shapley,
               "order-independent shares (Shapley) of groups of steps: 30 more frames, 62 with --classify post");
  options.word("--formats", to.formats, "OPERANDS[,SUMS]",
               "of floats instead of the device's integers: fp16, bf16, tf19, e5m2, e4m3 or fp32");
  options.flag("--tile-centres", to.tile_centres, "floats: centres relative to the tile of a pixel");
  options.flag("--flush-subnormals", to.flush_subnormals, "floats: results below the least normal number are 0");
  options.group("Output");
  options.word("--blame", to.blame, "FILE",
               "write a map of the step with the largest error in each pixel, with legend, .png");
  options.word("--maps", to.maps, "PREFIX",
               "write each step's signed error: PREFIX.STEP.png with legend, PREFIX.STEP.exr with values");
  declare(options, to.common);
  options.example("fastsplat errors --volume shells:32 --size 64 --config base --blame blame.png",
                  "each step's share of the error, and where it occurs");
  options.example("fastsplat errors --volume shells:32 --size 64 --config tiny --quick --json errors.json",
                  "a third of the time, as JSON");
  options.example("fastsplat errors --gaussians shells:500 --size 96 --formats fp16,fp32 --quick",
                  "what half floats would cost, with sums of binary32");
}

}  // namespace

const Subcommand subcommands::errors{"errors", "attribute the device's error to its steps",
                                     subcommand<ErrorsArguments, declare, run>};

}  // namespace fastsplat::cli
