// SPDX-License-Identifier: Apache-2.0
// fastsplat pixel: how one pixel comes about, device beside real.
#include <nlohmann/json.hpp>

#include "analysis/errors/pixel_report.hpp"
#include "base/number_text.hpp"
#include "cli/errors_output.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/staged_scene.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct PixelArguments {
  Common common;
  std::string at;  ///< "X,Y"
  StagedFlags of;
  int lsb_bits = 8;
  bool all = false;
  std::optional<int> sheet;
};

glm::ivec2 place_of(const std::string& text) {
  const auto comma = text.find(',');
  const auto x = integer_from<int>(std::string_view(text).substr(0, comma));
  const auto y =
      comma == std::string::npos ? std::nullopt : integer_from<int>(std::string_view(text).substr(comma + 1));
  if (!x || !y) {
    throw_usage({.where = "pixel",
                 .what = "not a pixel",
                 .expected = "X,Y, two whole numbers",
                 .got = "'" + text + "'",
                 .fix = "for example 64,40: 0,0 is the picture's top left"});
  }
  return {*x, *y};
}

ExitCode run(const PixelArguments& arguments) {
  const Output output(arguments.common);
  const glm::ivec2 at = place_of(arguments.at);
  StagedScene scene(arguments.of);
  const cmodel::Config& config = scene.config();
  check_outputs({.images = {}, .maps = {}, .raws = {}, .others = {arguments.common.json}, .inputs = scene.inputs()});
  scene.read(output);
  const auto made = scene.chain(config, arguments.common.threads);
  const stages::Chain& chain = *made;
  const analysis::PixelReport report = analysis::explain(chain, at.x, at.y, arguments.common.threads);
  output.line(errors_heading(scene.summary(), config) +
              analysis::to_text(report, chain, {.all = arguments.all, .sheet = arguments.sheet}, arguments.lsb_bits));
  auto json = errors_identity("pixel", scene.summary(), config);
  json.update(analysis::to_json(report, chain));
  output.json(json);
  return ExitCode::Pass;
}

void declare(Options& options, PixelArguments& to) {
  options.positional("PIXEL", to.at, "X,Y in pixels; 0,0 is the top left");
  options.only_values([] { return std::vector<std::string>{}; });
  declare(options, to.of);
  options.group("Output");
  options.integer("--lsb-bits", to.lsb_bits, 1, 24, "N", "one LSB is 1/(2^N - 1)");
  options.flag("--all", to.all,
               "show the splats of every sheet, or every Gaussian, not only of the one in which the error grows most");
  options.integer("--sheet", to.sheet, 0, 1L << 30, "N", "show the splats of this sheet, or this Gaussian of the file");
  declare(options, to.common);
  options.example("fastsplat pixel 32,20 --volume shells:32 --size 64 --config base",
                  "the pixel sheet by sheet, and the splats of its worst sheet");
  options.example("fastsplat pixel 32,20 --volume shells:32 --size 64 --config tiny --json pixel.json",
                  "every sheet and splat, as JSON");
  options.example("fastsplat pixel 48,40 --gaussians shells:500 --size 96", "Gaussian by Gaussian");
}

}  // namespace

const Subcommand subcommands::pixel{"pixel", "follow one pixel: every splat, sheet and word, device beside real",
                                    subcommand<PixelArguments, declare, run>};

}  // namespace fastsplat::cli
