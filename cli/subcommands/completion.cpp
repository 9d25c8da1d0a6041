// SPDX-License-Identifier: Apache-2.0
// fastsplat completion: scripts that complete subcommands, flags and values in a shell.
#include "cli/help/completion.hpp"

#include "cli/command_line.hpp"
#include "cli/output.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct CompletionArguments {
  std::string shell;
};

ExitCode run(const CompletionArguments& arguments) {
  write_stdout(completion_script(arguments.shell, describe()));
  return ExitCode::Pass;
}

void declare(Options& options, CompletionArguments& to) {
  options.positional("SHELL", to.shell, "bash, zsh or fish");
  options.only_values(completion_shells);
  options.example("fastsplat completion bash > fastsplat.bash",
                  "a script for bash; `source` it, or install it (docs/guide/other-systems.md)");
  options.example("fastsplat completion zsh > _fastsplat", "a script for zsh, in a folder of its fpath");
  options.example("fastsplat completion fish > fastsplat.fish", "a script for fish, in ~/.config/fish/completions");
}

}  // namespace

const Subcommand subcommands::completion{
    "completion", "print a script for bash, zsh or fish that completes subcommands, flags and names",
    subcommand<CompletionArguments, declare, run>};

}  // namespace fastsplat::cli
