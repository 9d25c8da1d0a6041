// SPDX-License-Identifier: Apache-2.0
// fastsplat stream record: records the device's input stream of a scene to a file.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/config_json.hpp"
#include "cli/device_report.hpp"
#include "cli/errors_output.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_flags.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"
#include "driver/files/stream_file.hpp"
#include "driver/tiles/gaussian_frame.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct StreamRecordArguments {
  Common common;
  SceneFlags scene;
  GaussianFlags gaussians;
  ConfigFlags config;
  std::string out;
};

void declare(Options& options, StreamRecordArguments& to) {
  declare(options, to.scene);
  declare(options, to.gaussians);
  options.group("Engine");
  declare(options, to.config, "hardware configuration, a name or a TOML file");
  options.group("Output");
  options.required("-o,--out", to.out, "FILE", "write the stream, .fss");
  declare(options, to.common);
  options.example("fastsplat stream record --volume shells:24 --size 64 --config tiny -o shells.fss",
                  "the device's input for a scene");
  options.example("fastsplat stream record --scene demo:layer-adding --size 64 --config base -o layers.fss",
                  "the stream of a built-in scene");
  options.example("fastsplat stream record --gaussians shells:200 --size 64 -o gaussians.fss",
                  "the stream of 3-D Gaussians");
}

/// Figures of the recording.
struct StreamRecordResult {
  std::string scene;  ///< its summary
  std::string stream;
  cmodel::Config config;
  driver::DriverReport driver;
};

std::string to_text(const StreamRecordResult& result) {
  return result.scene + "\n" + cli::to_text(result.driver) + result.stream + "\n";
}

Json to_json(const StreamRecordResult& result) {
  Json json{{"verb", "stream record"},
            {"version", program_version()},
            {"scene", result.scene},
            {"stream", result.stream},
            {"config", config_identity_json(result.config)}};
  json.update(cli::to_json(result.driver));
  return json;
}

/// 3-D Gaussians instead of a volume.
ExitCode record_gaussians(const StreamRecordArguments& arguments, const cmodel::Config& config, const Output& output) {
  const scene::GaussianScene scene =
      build(arguments.gaussians, describe_for_device(arguments.gaussians, arguments.scene));
  driver::check_image_size(scene.camera.width(), scene.camera.height());
  const auto frame = compile(scene, config, arguments.common, output);
  driver::GaussianReport report;
  {
    ProgressBar bar("recording", watching(arguments.common));
    report = driver::record_stream(frame, arguments.out, bar.callback());
  }
  output.line(fmt::format("{}driver: {}, {}\n{}\n", errors_heading(summary(scene), config),
                          counted(report.records, "ellipse record"), counted(report.tiles, "tile"), arguments.out));
  output.remark(remarks(*scene.cloud));
  output.json(Json{{"verb", "stream record"},
                   {"version", program_version()},
                   {"scene", summary(scene)},
                   {"stream", arguments.out},
                   {"config", config_identity_json(config)},
                   {"driver", {{"records", report.records}, {"in_tiles", report.in_tiles}, {"tiles", report.tiles}}}});
  output.note_time("recorded");
  return ExitCode::Pass;
}

ExitCode run(const StreamRecordArguments& arguments) {
  const Output output(arguments.common);
  if (!arguments.out.ends_with(".fss")) {
    throw_usage({.where = arguments.out,
                 .what = "the name of a stream file must end in .fss",
                 .expected = {},
                 .got = {},
                 .fix = "for example --out scene.fss"});
  }
  refuse_display(arguments.scene);
  check_outputs(
      {.images = {},
       .maps = {},
       .raws = {},
       .others = {arguments.out, arguments.common.json},
       .inputs = joined(arguments.gaussians.file ? inputs_of(arguments.gaussians) : inputs_of(arguments.scene),
                        inputs_of_config(arguments.config.config.value_or("")))});
  if (arguments.gaussians.file) return record_gaussians(arguments, load_for_gaussians(arguments.config), output);
  refuse_without_gaussians(arguments.gaussians);
  const auto config = load(arguments.config);
  const auto description = describe(arguments.scene);
  driver::check_image_size(description.width, description.height);
  const auto scene = scene::build_scene(description);
  output.remark(remarks(scene));

  StreamRecordResult result{.scene = summary(scene), .stream = arguments.out, .config = config, .driver = {}};
  {
    ProgressBar bar("recording", watching(arguments.common));
    result.driver = driver::record_stream(scene, config, arguments.out,
                                          {.threads = arguments.common.threads, .progress = bar.callback()});
  }
  output.line(to_text(result));
  output.remark(remarks(result.driver));
  output.json(to_json(result));
  output.note_time("recorded");
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::stream_record{"stream record", "compile a scene into a stream file",
                                            subcommand<StreamRecordArguments, declare, run>};

}  // namespace fastsplat::cli
