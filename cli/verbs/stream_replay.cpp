// fastsplat stream replay: a recorded stream through the integer device.
#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/device_report.hpp"
#include "cli/image_output.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/verbs/verbs.hpp"
#include "driver/config_file.hpp"
#include "driver/render.hpp"
#include "driver/stream_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  Common common;
  std::string stream, config = "base", raw;
  std::vector<std::string> out;
};

void declare(Options& options, Arguments& to) {
  options.positional("STREAM", to.stream, "a stream file");
  options.group("Engine");
  options.word("--config", to.config, "NAME|FILE", "the configuration it was recorded for");
  declare_images(options, to.out, to.raw);
  declare(options, to.common);
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.images = arguments.out,
                 .maps = {},
                 .raws = {arguments.raw},
                 .others = {arguments.common.json},
                 .inputs = {arguments.stream}});
  const auto config = driver::load_config(arguments.config);
  driver::DeviceRender result;
  {
    ProgressBar bar("replaying", watching(arguments.common));
    result = driver::replay_stream(arguments.stream, config,
                                   {.threads = arguments.common.threads, .progress = bar.callback()});
  }
  Json json{{"verb", "stream replay"},
            {"version", program_version()},
            {"stream", arguments.stream},
            {"width", result.frame.width},
            {"height", result.frame.height}};
  report_device(result, config, output, json);
  const images::Metadata metadata{{"engine", "cmodel"},
                                  {"version", program_version()},
                                  {"stream", arguments.stream},
                                  {"config", config.name},
                                  {"config_hash", hash_text(cmodel::config_hash(config))}};
  write_device_images(result, arguments.out, arguments.raw, metadata, output);
  json["outputs"] = arguments.out;
  if (!arguments.raw.empty()) json["raw"] = arguments.raw;
  json["seconds"] = output.seconds();
  output.json(json.dump(2));
  output.note_time("replayed");
  return ExitCode::Pass;
}

}  // namespace

const Verb verbs::stream_replay{"stream replay", "feeds a stream to the integer device", verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
