// fastsplat stream record: what the device is fed for a scene, in a file.
#include <nlohmann/json.hpp>

#include "base/version.hpp"
#include "cli/config_json.hpp"
#include "cli/device_report.hpp"
#include "cli/image_output.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_flags.hpp"
#include "cli/verbs/verbs.hpp"
#include "driver/config_file.hpp"
#include "driver/stream_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  Common common;
  SceneFlags scene;
  std::string config = "base", out;
};

void declare(Options& options, Arguments& to) {
  declare(options, to.scene);
  options.group("Engine");
  options.word("--config", to.config, "NAME|FILE", "hardware configuration, a name or a TOML file");
  options.group("Output");
  options.required("-o,--out", to.out, "FILE", "the stream file, .fss");
  declare(options, to.common);
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  if (!arguments.out.ends_with(".fss")) {
    throw_usage({.where = arguments.out,
                 .what = "a stream file's name ends in .fss",
                 .expected = {},
                 .got = {},
                 .fix = "for example --out scene.fss"});
  }
  check_outputs({.images = {}, .maps = {}, .raws = {}, .others = {arguments.out, arguments.common.json}, .inputs = {}});
  const auto config = driver::load_config(arguments.config);
  const auto scene = build(arguments.scene);

  driver::DriverReport report;
  {
    ProgressBar bar("recording", watching(arguments.common));
    report = driver::record_stream(scene, config, arguments.out,
                                   {.threads = arguments.common.threads, .progress = bar.callback()});
  }
  Json json{{"verb", "stream record"},
            {"version", program_version()},
            {"stream", arguments.out},
            {"config", config_identity_json(config)}};
  output.line(summary(scene));
  report_driver(report, output, json);
  output.line(arguments.out);
  output.json(json.dump(2));
  output.note_time("recorded");
  return ExitCode::Pass;
}

}  // namespace

const Verb verbs::stream_record{"stream record", "compiles a scene into a stream file", verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
