// SPDX-License-Identifier: Apache-2.0
// fastsplat stream dump: a stream file as text.
#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "driver/files/stream_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct StreamDumpArguments {
  Common common;
  std::string stream;
  std::optional<int> limit;
};

void declare(Options& options, StreamDumpArguments& to) {
  options.positional("STREAM", to.stream, "a stream file");
  options.group("Output");
  options.integer("--limit", to.limit, 0, 2'000'000'000, "N", "stop after N records");
  declare(options, to.common);
  options.example("fastsplat stream dump shells.fss --limit 20", "the first records, one line each");
  options.example("fastsplat stream dump shells.fss | grep -c splat", "the number of records of one kind");
}

ExitCode run(const StreamDumpArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}, .inputs = {arguments.stream}});
  const auto limit = static_cast<std::uint64_t>(arguments.limit.value_or(INT32_MAX));
  const bool text_wanted = !arguments.common.quiet && arguments.common.json != "-";
  Json records = Json::array();
  std::string buffer;
  std::uint64_t count = 0;
  const auto print_line = [&](const std::string& line) {
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
  };
  // Dumps the valid part of the stream before reporting its error.
  std::optional<UserError> wrong;
  try {
    driver::dump_stream(arguments.stream, print_line);
  } catch (const UserError& error) {
    wrong = error;
  }
  if (wrong && count == 0) throw *wrong;
  if (text_wanted) write_stdout(buffer);
  Json json{{"verb", "stream dump"}, {"stream", arguments.stream}, {"records", std::move(records)}};
  if (wrong) json["error"] = wrong->what();
  output.json(json);
  if (wrong) throw *wrong;
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::stream_dump{"stream dump", "print a stream, one line per record",
                                          subcommand<StreamDumpArguments, declare, run>};

}  // namespace fastsplat::cli
