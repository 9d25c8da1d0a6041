// SPDX-License-Identifier: Apache-2.0
// fastsplat lab: the command that draws what a link to the lab's page shows.
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/shell_word.hpp"
#include "base/version.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "lab/link.hpp"
#include "lab/request.hpp"

namespace fastsplat::cli {
namespace {

struct LabArguments {
  Common common;
  std::string link, folder;
};

/// The files that a command for this state names and the link holds.
std::vector<std::pair<std::filesystem::path, std::string>> files_of(const nlohmann::ordered_json& state,
                                                                    const std::string& folder) {
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  for (const auto& [key, name] : {std::pair{"tf_toml", "tf.toml"}, {"toml", "mine.toml"}}) {
    if (const auto text = state.at(key).get<std::string>(); !text.empty())
      files.emplace_back(std::filesystem::path(folder) / name, text);
  }
  return files;
}

ExitCode run(const LabArguments& arguments) {
  const Output output(arguments.common);
  if (arguments.link.empty()) {
    throw_usage({.where = {},
                 .what = "nothing to do",
                 .expected = "--print LINK",
                 .got = {},
                 .fix = "copy the address of the lab's page; ./run lab makes the page"});
  }
  const auto state = lab::state_of_link(arguments.link);
  for (const auto& word : state.value("ignored", nlohmann::ordered_json::array()))
    output.warn("the page does not follow this word of the link: " + word.get<std::string>());
  const auto files = files_of(state, arguments.folder);
  std::vector<std::string> names{arguments.common.json};
  if (!arguments.folder.empty()) {
    for (const auto& [path, text] : files) names.push_back(path.string());
  }
  check_outputs({.others = names});
  const auto request = lab::request_of_state(state);
  const std::string command = lab::command_line(request, lab::read_request(request));
  output.line(command);
  for (const auto& [path, text] : files) {
    if (arguments.folder.empty())
      output.warn("the link holds " + path.string() + "; use --files . to write it");
    else
      write_text_file(path, text);
  }
  output.json({{"verb", "lab"}, {"version", program_version()}, {"command", command}, {"state", state}});
  return ExitCode::Pass;
}

void declare(Options& options, LabArguments& to) {
  options.group("Link");
  options.word("--print", to.link, "LINK", "print the command that draws the same words as the page of this link");
  options.word("--files", to.folder, "FOLDER",
               "write the link's own transfer function (tf.toml) and configuration (mine.toml) to this folder");
  declare(options, to.common);
  options.example("fastsplat lab --print '#lab?volume=shells:32&config=tiny&size=96x96&s.camera.azimuth=40'",
                  "from the page's picture to the program's");
  options.example("fastsplat lab --print '#lab?volume=shells:32&k.sheet.frac_bits=10' --json link.json",
                  "the command, and everything that the link holds");
}

}  // namespace

const Subcommand subcommands::lab{"lab", "print the command that draws what a link to the lab's page shows",
                                  subcommand<LabArguments, declare, run>};

}  // namespace fastsplat::cli
