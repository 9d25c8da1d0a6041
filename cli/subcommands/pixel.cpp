// SPDX-License-Identifier: Apache-2.0
// fastsplat pixel: how one pixel comes about, device beside real.
#include <nlohmann/json.hpp>

#include "analysis/errors/pixel_report.hpp"
#include "base/number_text.hpp"
#include "cli/errors_output.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/staged_scene.hpp"
#include "cli/stream_config.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "driver/files/stream_file.hpp"
#include "testbench/triage/pixel_words.hpp"

namespace fastsplat::cli {
namespace {

struct PixelArguments {
  Common common;
  std::string at;  ///< "X,Y"
  StagedFlags of;
  std::optional<int> lsb_bits;
  bool all = false;
  std::optional<int> sheet;
  std::optional<std::string> stream;  ///< instead of a scene
  std::optional<int> tile;
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

/// A stream has the device's words only.
ExitCode run_stream(const PixelArguments& arguments, const glm::ivec2& at, const Output& output) {
  const GaussianFlags& gaussians = arguments.of.gaussians;
  if (arguments.of.scene != SceneFlags{} || gaussians.file || arguments.sheet || arguments.all || arguments.lsb_bits) {
    throw_usage({.where = "--stream",
                 .what = "cannot be combined with a scene's flags, --sheet, --all or --lsb-bits",
                 .expected = {},
                 .got = {},
                 .fix = "leave them out: a stream has the device's words only, and all of them are shown"});
  }
  refuse_without_gaussians(gaussians);
  const cmodel::Config config = load(for_stream(arguments.of.config, *arguments.stream));
  check_outputs({.images = {},
                 .maps = {},
                 .raws = {},
                 .others = {arguments.common.json},
                 .inputs = joined(inputs_of_config(arguments.of.config.config.value_or("")), {*arguments.stream})});
  const testbench::TilePixel asked{static_cast<std::uint32_t>(arguments.tile.value_or(0)), at.x, at.y};
  testbench::PixelWords words;
  const auto source = [&](const cmodel::BeatSink& sink) { driver::read_beats(*arguments.stream, sink); };
  driver::naming(*arguments.stream, [&] {
    words = testbench::words_of_pixel(source, config, asked, !arguments.tile, cmodel::StreamScope::Whole);
  });
  output.line(errors_heading(*arguments.stream, config) + testbench::to_text(words));
  auto json = errors_identity("pixel", *arguments.stream, config);
  json.update(testbench::to_json(words));
  output.json(json);
  return ExitCode::Pass;
}

ExitCode run(const PixelArguments& arguments) {
  const Output output(arguments.common);
  const glm::ivec2 at = place_of(arguments.at);
  if (arguments.stream) return run_stream(arguments, at, output);
  if (arguments.tile) {
    throw_usage({.where = "--tile",
                 .what = "numbers tiles of a stream",
                 .expected = {},
                 .got = {},
                 .fix = "add --stream FILE, or leave it out"});
  }
  StagedScene scene(arguments.of);
  const cmodel::Config& config = scene.config();
  check_outputs({.images = {}, .maps = {}, .raws = {}, .others = {arguments.common.json}, .inputs = scene.inputs()});
  scene.read(output);
  const auto made = scene.chain(arguments.common.threads, output);
  const stages::Chain& chain = *made;
  const analysis::PixelReport report = analysis::explain(chain, at.x, at.y, arguments.common.threads);
  output.line(errors_heading(scene.summary(), config) +
              analysis::to_text(report, chain, {.all = arguments.all, .sheet = arguments.sheet},
                                arguments.lsb_bits.value_or(8)));
  auto json = errors_identity("pixel", scene.summary(), config);
  json.update(analysis::to_json(report, chain));
  output.json(json);
  return ExitCode::Pass;
}

void declare(Options& options, PixelArguments& to) {
  options.positional("PIXEL", to.at, "X,Y in pixels; 0,0 is the top left");
  options.only_values([] { return std::vector<std::string>{}; });
  declare(options, to.of);
  options.group("Stream");
  options.word("--stream", to.stream, "FILE", "instead of a scene: the device's words of a recorded stream, .fss");
  options.integer("--tile", to.tile, 0, 1L << 30, "N", "X,Y lie in this tile, as in reports of `verify`");
  options.group("Output");
  options.integer("--lsb-bits", to.lsb_bits, 1, 24, "N", "one LSB is 1/(2^N - 1) (8)");
  options.flag("--all", to.all,
               "show the splats of every sheet, or every Gaussian, not only of the one in which the error grows most");
  options.integer("--sheet", to.sheet, 0, 1L << 30, "N", "show the splats of this sheet, or this Gaussian of the file");
  declare(options, to.common);
  options.example("fastsplat pixel 32,20 --volume shells:32 --size 64 --config base",
                  "the pixel sheet by sheet, and the splats of its worst sheet");
  options.example("fastsplat pixel 48,40 --gaussians shells:500 --size 96", "Gaussian by Gaussian");
  options.example("fastsplat pixel 3,0 --tile 0 --stream shells.fss --config tiny",
                  "the device's words, as behind a mismatch that `verify` reports");
}

}  // namespace

const Subcommand subcommands::pixel{"pixel", "follow one pixel: every splat, sheet and word, device beside real",
                                    subcommand<PixelArguments, declare, run>};

}  // namespace fastsplat::cli
