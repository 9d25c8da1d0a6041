// SPDX-License-Identifier: Apache-2.0
// fastsplat errors file: what an encoded file of Gaussians costs, and the device behind it.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/errors/file_errors.hpp"
#include "cli/errors_output.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct ErrorsFileArguments {
  Common common;
  std::string original, encoded;
  SceneFlags scene;
  GaussianFlags gaussians;
  ConfigFlags config;
  int lsb_bits = 8;
};

ExitCode run(const ErrorsFileArguments& arguments) {
  const Output output(arguments.common);
  GaussianFlags flags = arguments.gaussians;
  if (flags.file) {
    throw_usage({.where = "--gaussians",
                 .what = "the scenes are the two arguments",
                 .expected = {},
                 .got = {},
                 .fix = "leave it out"});
  }
  flags.file = arguments.original;
  refuse_display(arguments.scene);
  const cmodel::Config config = load_for_gaussians(arguments.config);
  const GaussianView view = describe_for_device(flags, arguments.scene);
  driver::check_drawable(view.description, config);
  check_outputs({.images = {},
                 .maps = {},
                 .raws = {},
                 .others = {arguments.common.json},
                 .inputs = joined(joined(inputs_of(flags), inputs_of_gaussians(arguments.encoded)),
                                  inputs_of_config(arguments.config.config.value_or("")))});
  const scene::GaussianScene scene = build(flags, view);
  auto encoded = read_gaussians(arguments.encoded, flags.strict);
  if (view.crop) scene::crop(encoded, *view.crop);
  output.remark(remarks(*scene.cloud));
  output.remark(remarks(encoded));
  if (encoded.linear != scene.cloud->linear)
    output.warn(
        fmt::format("the encoded file declares {} colours, the original {}: figures compare the files' own "
                    "numbers, but pictures for display differ in brightness",
                    encoded.linear ? "linear" : "sRGB", scene.cloud->linear ? "linear" : "sRGB"));
  analysis::FileErrors errors;
  {
    ProgressBar bar("errors", watching(arguments.common));
    errors = analysis::file_errors(scene, encoded, config, arguments.common.threads, bar.callback());
  }
  output.remark(remarks(errors.report, config));
  if (10 * errors.matched < 9 * std::min(errors.original, errors.encoded))
    output.warn(fmt::format("only {} found again: shares of attributes are of these alone",
                            counted(errors.matched, "Gaussian")));
  output.line(errors_heading(summary(scene), config) + analysis::to_text(errors, arguments.lsb_bits));
  nlohmann::ordered_json json = errors_identity("errors file", summary(scene), config);
  json["files"] = {scene.cloud->source, encoded.source};
  json.update(analysis::to_json(errors));
  output.json(json);
  output.note_time("attributed");
  return ExitCode::Pass;
}

void declare(Options& options, ErrorsFileArguments& to) {
  options.positional("original", to.original,
                     "the scene before encoding: a file, or a built-in scene such as shells:2000");
  options.positional("encoded", to.encoded, "the same scene, encoded");
  declare(options, to.scene);
  declare(options, to.gaussians);
  options.group("Device");
  declare(options, to.config, "hardware configuration, a name or a TOML file");
  options.group("Analysis");
  options.integer("--lsb-bits", to.lsb_bits, 1, 24, "N", "one LSB is 1/(2^N - 1)");
  declare(options, to.common);
  options.example("fastsplat errors file shells:300 shells:300 --size 64", "the device alone: the files are the same");
  options.example("fastsplat errors file shells:300 shells:200 --size 64 --json costs.json", "two scenes, as JSON");
}

}  // namespace

const Subcommand subcommands::errors_file{"errors file", "attribute an encoded scene's error to its attributes",
                                          subcommand<ErrorsFileArguments, declare, run>};

}  // namespace fastsplat::cli
