// SPDX-License-Identifier: Apache-2.0
// A subcommand: its name, its flags, its action. One file each in cli/subcommands/.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "cli/options.hpp"

namespace fastsplat::cli {

/// A parsed command line, not yet run. Throws UserError for run-time errors.
using Action = std::function<ExitCode()>;

struct Subcommand {
  const char* name;             ///< as typed: "render", "stream record"
  const char* summary;          ///< one line of the help
  Action (*declare)(Options&);  ///< null for a group such as "stream"
};

/// A Subcommand's `declare`, from the two functions that its file holds.
template <class Arguments, void (*declare)(Options&, Arguments&), ExitCode (*run)(const Arguments&)>
Action subcommand(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  declare(options, *arguments);
  return [arguments] { return run(*arguments); };
}

/// All subcommands in the order of the help; a group precedes its subcommands.
const std::vector<Subcommand>& all_subcommands();

}  // namespace fastsplat::cli
