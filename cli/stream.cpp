// fastsplat stream record|dump|replay: what the device is fed, in a file.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/device_report.hpp"
#include "cli/image_output.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_flags.hpp"
#include "cli/verbs.hpp"
#include "driver/config_file.hpp"
#include "driver/render.hpp"
#include "driver/stream_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

Watching watching(const Common& common) { return common.quiet ? Watching::Never : Watching::IfTerminal; }

}  // namespace

ExitCode run(const StreamRecordArguments& arguments) {
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
            {"config", {{"name", config.name}, {"hash", hash_text(cmodel::config_hash(config))}}}};
  output.line(summary(scene));
  report_driver(report, output, json);
  output.line(arguments.out);
  output.json(json.dump(2));
  output.note_time("recorded");
  return ExitCode::Pass;
}

ExitCode run(const StreamDumpArguments& arguments) {
  const Output output(arguments.common);
  const auto limit = static_cast<std::uint64_t>(arguments.limit.value_or(INT32_MAX));
  const bool text_wanted = !arguments.common.quiet && arguments.common.json != "-";
  Json records = Json::array();
  std::string buffer;
  std::uint64_t count = 0;
  driver::dump_stream(arguments.stream, [&](const std::string& line) {
    if (count == limit) return false;
    ++count;
    if (!arguments.common.json.empty()) records.push_back(line);
    if (!text_wanted) return true;
    buffer += line;
    buffer += '\n';
    if (buffer.size() < 1 << 16) return true;
    const bool more = write_stdout(buffer);
    buffer.clear();
    return more;
  });
  if (text_wanted) write_stdout(buffer);
  output.json(Json{{"verb", "stream dump"}, {"stream", arguments.stream}, {"records", std::move(records)}}.dump(2));
  return ExitCode::Pass;
}

ExitCode run(const StreamReplayArguments& arguments) {
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

}  // namespace fastsplat::cli
