// SPDX-License-Identifier: Apache-2.0
// fastsplat stream replay: a recorded stream through the integer device.
#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/device_report.hpp"
#include "cli/image_output.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/stream_config.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "driver/files/stream_file.hpp"
#include "driver/tiles/render.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct StreamReplayArguments {
  Common common;
  ConfigFlags config;
  std::string stream, raw;
  std::vector<std::string> out;
};

void declare(Options& options, StreamReplayArguments& to) {
  options.positional("STREAM", to.stream, "a stream file");
  options.group("Engine");
  declare(options, to.config, "the configuration it was recorded for (found by its hash)");
  declare_images(options, to.out, to.raw);
  declare(options, to.common);
  options.example("fastsplat stream replay shells.fss --config tiny -o shells.png", "the picture of a stream");
  options.example("fastsplat stream replay shells.fss --config tiny --raw words.exr --json -",
                  "the raw words, and the device's counters as JSON");
}

/// Figures of the replay; its pixels are in the files.
struct StreamReplayResult {
  std::string stream;
  int width = 0, height = 0;
  DeviceReport device;
  std::vector<std::string> outputs;
  std::string raw;  ///< empty for none
  double seconds = 0.0;
};

Json to_json(const StreamReplayResult& result) {
  Json json{{"verb", "stream replay"},
            {"version", program_version()},
            {"stream", result.stream},
            {"width", result.width},
            {"height", result.height}};
  json.update(cli::to_json(result.device));
  json["outputs"] = result.outputs;
  if (!result.raw.empty()) json["raw"] = result.raw;
  json["seconds"] = result.seconds;
  return json;
}

ExitCode run(const StreamReplayArguments& arguments) {
  const Output output(arguments.common);
  const auto config = load(for_stream(arguments.config, arguments.stream));
  check_outputs({.images = arguments.out,
                 .maps = {},
                 .raws = {arguments.raw},
                 .others = {arguments.common.json},
                 .inputs = joined(inputs_of_config(arguments.config.config.value_or("")), {arguments.stream})});
  driver::DeviceRender frame;
  {
    ProgressBar bar("replaying", watching(arguments.common));
    frame = driver::replay_stream(arguments.stream, config,
                                  {.threads = arguments.common.threads, .progress = bar.callback()});
  }
  StreamReplayResult result{.stream = arguments.stream,
                            .width = frame.frame.width,
                            .height = frame.frame.height,
                            .device = {config, frame.report, frame.counters},
                            .outputs = arguments.out,
                            .raw = arguments.raw};
  output.line(to_text(result.device));
  output.remark(remarks(result.device));
  const images::Metadata metadata{{"engine", "cmodel"},
                                  {"version", program_version()},
                                  {"stream", arguments.stream},
                                  {"config", config.name},
                                  {"config_hash", hash_text(cmodel::config_hash(config))}};
  write_device_images(frame.frame, arguments.out, arguments.raw, {}, metadata, output);
  result.seconds = output.seconds();
  output.json(to_json(result));
  output.note_time("replayed");
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::stream_replay{"stream replay", "feed a stream to the integer device",
                                            subcommand<StreamReplayArguments, declare, run>};

}  // namespace fastsplat::cli
