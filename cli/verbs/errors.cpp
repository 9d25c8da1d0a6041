// fastsplat errors: because of which step is the device's picture not the true one.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/compare.hpp"
#include "analysis/errors/attribution_report.hpp"
#include "analysis/provenance.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/config_json.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_flags.hpp"
#include "cli/verbs/verbs.hpp"
#include "cli/volume_json.hpp"
#include "images/image_file.hpp"

namespace fastsplat::cli {
namespace {

struct Arguments {
  Common common;
  SceneFlags scene;
  ConfigFlags config;
  int lsb_bits = 8;
  bool quick = false, shapley = false;
  std::string blame, maps;  ///< empty for none
};

using Json = nlohmann::ordered_json;

struct Result {
  std::string scene;  ///< its summary
  cmodel::Config config;
  analysis::Attribution attribution;
  std::optional<analysis::TriedRemedy> tried;
  int lsb_bits = 8;
};

std::string to_text(const Result& result) {
  return fmt::format("{}; configuration {} {}\n", result.scene, result.config.name,
                     hash_text(cmodel::config_hash(result.config))) +
         analysis::to_text(result.attribution, result.tried, result.lsb_bits);
}

Json to_json(const Result& result) {
  Json json{{"verb", "errors"},
            {"version", program_version()},
            {"scene", result.scene},
            {"config", config_identity_json(result.config)}};
  json.update(analysis::to_json(result.attribution, result.tried));
  return json;
}

/// "PREFIX.STEP.png" and ".exr" of every step, and of the whole error.
std::vector<std::string> map_names(const std::string& prefix, const std::vector<stages::StepSet>& sets,
                                   const char* ending) {
  if (prefix.empty()) return {};
  std::vector<std::string> names{prefix + ".error" + ending};
  for (const stages::StepSet& set : sets) names.push_back(prefix + "." + analysis::file_word(set.name) + ending);
  return names;
}

void write_maps(const Arguments& arguments, const Result& result, const images::Metadata& metadata) {
  const analysis::Attribution& a = result.attribution;
  std::vector<stages::StepSet> sets;
  for (const analysis::StepError& step : a.steps) sets.push_back(step.set);
  const Image real = analysis::to_image(a.real);
  const auto write = [&](std::size_t at, const stages::Picture& error) {
    const auto pngs = map_names(arguments.maps, sets, ".png"), exrs = map_names(arguments.maps, sets, ".exr");
    const Image signed_error = analysis::to_image(error);
    Image test = real;
    for (std::size_t i = 0; i < test.data.size(); ++i) test.data[i] += signed_error.data[i];
    images::write_image(pngs[at], analysis::lsb_map(real, test, {.lsb_bits = arguments.lsb_bits}),
                        {{"display", "srgb"}}, {.display = true});
    images::write_image(exrs[at], signed_error, metadata);
  };
  stages::Picture error = a.device;
  for (std::size_t i = 0; i < error.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) error.pixels[i][c] -= a.real.pixels[i][c];
  }
  write(0, error);
  for (std::size_t k = 0; k < a.increments.size(); ++k) write(k + 1, a.increments[k]);
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  const cmodel::Config config = load(arguments.config);
  const auto sets = stages::step_sets(config, driver::carries(describe(arguments.scene).method, config));
  check_outputs({.images = map_names(arguments.maps, sets, ".exr"),
                 .maps = joined(map_names(arguments.maps, sets, ".png"), {arguments.blame}),
                 .raws = {},
                 .others = {arguments.common.json},
                 .inputs = joined(inputs_of(arguments.scene), inputs_of_config(arguments.config.config.value_or("")))});
  const scene::Scene scene = build(arguments.scene);
  output.remark(remarks(*scene.volume));
  Result result{
      .scene = summary(scene), .config = config, .attribution = {}, .tried = {}, .lsb_bits = arguments.lsb_bits};
  {
    const stages::Chain chain(scene, config);
    ProgressBar bar("errors", watching(arguments.common));
    result.attribution = analysis::attribute(chain, {.quick = arguments.quick,
                                                     .shapley = arguments.shapley,
                                                     .threads = arguments.common.threads,
                                                     .progress = bar.callback()});
  }
  result.tried = analysis::try_remedy(scene, config, result.attribution, arguments.common.threads);
  if (!arguments.blame.empty())
    images::write_image(arguments.blame, analysis::blame_map(result.attribution), {{"display", "srgb"}},
                        {.display = true});
  if (!arguments.maps.empty())
    write_maps(
        arguments, result,
        analysis::render_metadata("errors", scene, analysis::HardwareConfig{config.name, cmodel::config_hash(config)}));
  output.line(to_text(result));
  output.json(to_json(result));
  output.note_time("attributed");
  return ExitCode::Pass;
}

void declare(Options& options, Arguments& to) {
  declare(options, to.scene);
  options.group("Device");
  declare(options, to.config, "hardware configuration, a name or a TOML file");
  options.group("Analysis");
  options.integer("--lsb-bits", to.lsb_bits, 1, 24, "N", "one LSB is 1/(2^N - 1)");
  options.flag("--quick", to.quick, "no step alone, none left out: a third of the frames");
  options.flag("--shapley", to.shapley, "shares of the five groups of steps, whatever the order: 30 frames more");
  options.group("Output");
  options.word("--blame", to.blame, "FILE", "which step rules each pixel, with legend, .png");
  options.word("--maps", to.maps, "PREFIX",
               "each step's signed error: PREFIX.STEP.png, with legend, and PREFIX.STEP.exr, its values");
  declare(options, to.common);
  options.example("fastsplat errors --volume shells:64 --size 256 --config base --blame blame.png");
}

}  // namespace

const Verb verbs::errors{"errors", "because of which step the device's picture is not the true one",
                         verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
