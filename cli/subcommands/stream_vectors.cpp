// SPDX-License-Identifier: Apache-2.0
// fastsplat stream vectors: a recorded stream and its expected taps and pixels, as plain text.
#include "driver/files/stream_vectors.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/config_json.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/stream_config.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct StreamVectorsArguments {
  Common common;
  ConfigFlags config;
  std::string stream, out;
};

void declare(Options& options, StreamVectorsArguments& to) {
  options.positional("STREAM", to.stream, "a stream file");
  options.group("Engine");
  declare(options, to.config, "the configuration it was recorded for (found by its hash)");
  options.group("Output");
  options.required("-o,--out", to.out, "FOLDER", "folder of the files; created in an existing folder if needed");
  declare(options, to.common);
  options.example("fastsplat stream vectors shells.fss --config tiny -o vectors", "beats and taps for your own bench");
  options.example("fastsplat stream vectors shells.fss --config tiny -o vectors --json -",
                  "the list of written files as JSON");
}

/// Figures of the written files.
struct StreamVectorsResult {
  std::string stream, folder;
  cmodel::Config config;
  driver::VectorReport vectors;
};

std::string to_text(const StreamVectorsResult& result) {
  std::uint64_t records = 0, bytes = 0;
  for (const auto count : result.vectors.taps) records += count;
  for (const auto& file : result.vectors.files) bytes += file.bytes;
  return counted(result.vectors.beats, "beat") + ", " + counted(records, "tap record") + ", " +
         counted(result.vectors.pixel_beats, "pixel beat") + "\n" + result.folder + ": vectors.json and " +
         counted(result.vectors.files.size(), "file") + " listed in it, " + grouped(bytes) + " bytes\n";
}

Json to_json(const StreamVectorsResult& result) {
  Json json{{"verb", "stream vectors"},
            {"version", program_version()},
            {"stream", result.stream},
            {"folder", result.folder},
            {"config", config_identity_json(result.config)},
            {"beats", result.vectors.beats},
            {"pixel_beats", result.vectors.pixel_beats}};
  for (std::size_t tap = 0; tap < result.vectors.taps.size(); ++tap)
    json["taps"][to_string(static_cast<cmodel::Tap>(tap))] = result.vectors.taps[tap];
  for (const auto& file : result.vectors.files)
    json["files"].push_back({{"name", file.name}, {"lines", file.lines}, {"bytes", file.bytes}});
  return json;
}

/// The output files if the folder exists; only then can one of them be an input.
std::vector<std::string> outputs_in(const std::string& folder) {
  std::vector<std::string> names;
  if (std::filesystem::is_directory(folder))
    for (const auto& name : driver::vector_file_names()) names.push_back(folder + "/" + name);
  return names;
}

ExitCode run(const StreamVectorsArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = joined({arguments.common.json}, outputs_in(arguments.out)),
                 .inputs = joined(inputs_of_config(arguments.config.config.value_or("")), {arguments.stream})});
  StreamVectorsResult result{.stream = arguments.stream,
                             .folder = arguments.out,
                             .config = load(for_stream(arguments.config, arguments.stream)),
                             .vectors = {}};
  {
    ProgressBar bar("writing", watching(arguments.common));
    result.vectors =
        driver::write_vectors(arguments.stream, result.config, arguments.out, {.progress = bar.callback()});
  }
  output.line(to_text(result));
  output.json(to_json(result));
  output.note_time("written");
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::stream_vectors{"stream vectors", "write a stream and its expected taps as plain text",
                                             subcommand<StreamVectorsArguments, declare, run>};

}  // namespace fastsplat::cli
