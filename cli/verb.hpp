// A verb of the command line: its name, its flags, what it does. One file each, in cli/verbs/.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "cli/options.hpp"

namespace fastsplat::cli {

/// A command line, understood and not begun. What goes wrong when it is carried out is a UserError.
using Action = std::function<ExitCode()>;

struct Verb {
  const char* name;             ///< as typed: "render", "stream record"
  const char* summary;          ///< one line of the help
  Action (*declare)(Options&);  ///< null for the head of a group, "stream"
};

/// A Verb's `declare`, from the two functions that its file holds.
template <class Arguments, void (*declare)(Options&, Arguments&), ExitCode (*run)(const Arguments&)>
Action verb(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  declare(options, *arguments);
  return [arguments] { return run(*arguments); };
}

/// All of them, in the order of the help; a group's head before its verbs.
const std::vector<Verb>& all_verbs();

}  // namespace fastsplat::cli
