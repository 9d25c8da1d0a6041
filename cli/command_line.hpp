// SPDX-License-Identifier: Apache-2.0
// Parses the command line into the action of a subcommand.
#pragma once

#include <string>
#include <vector>

#include "cli/subcommand.hpp"

namespace fastsplat::cli {

/// Throws UserError (Usage), with the fix, for an invalid command line. --help, --version and `help` become actions
/// that print.
Action parse(int argc, const char* const* argv, const std::vector<Subcommand>& subcommands = all_subcommands());

/// Parses, calls, prints an error and returns the exit code (docs/guide/reference.md, "Exit codes").
int run_program(int argc, const char* const* argv);

/// All long flags of a subcommand, such as "--size"; UserError (Usage) for unknown subcommands.
std::vector<std::string> flags_of(const std::string& subcommand,
                                  const std::vector<Subcommand>& subcommands = all_subcommands());

/// Help text of the subcommand that `words` name, or of the program if empty. UserError (Usage) for unknown names.
std::string help_on(const std::vector<std::string>& words,
                    const std::vector<Subcommand>& subcommands = all_subcommands());

/// Descriptions of the program itself, then of all subcommands in the order of `subcommands`.
std::vector<Description> describe(const std::vector<Subcommand>& subcommands = all_subcommands());

/// The entry of `all` named by `words`; the program's own if empty. UserError (Usage) for unknown names.
const Description& described(const std::vector<std::string>& words, const std::vector<Description>& all);

}  // namespace fastsplat::cli
