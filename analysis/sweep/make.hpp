// SPDX-License-Identifier: Apache-2.0
// Makes a plan from a specification: crosses axes, puts settings into the commands that take them, names cases.
#pragma once

#include <functional>

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/spec.hpp"
#include "base/progress.hpp"

namespace fastsplat::plan {

/// The program's interface for this folder: its subcommands, and the content behind the names in settings.
struct Vocabulary {
  /// "--size", ...; throws UserError (Usage) for an unknown subcommand.
  std::function<std::vector<std::string>(const std::string& subcommand)> flags_of;
  /// Throws UserError for words, from the subcommand on, that the program would refuse before it reads a volume.
  std::function<void(const Words& words)> check;
  /// Throws UserError for unknown names and for broken limits between keys.
  std::function<Content(const Settings& settings, const std::vector<std::string>& subcommands)> content;
};

struct Made {
  Plan plan;
  std::vector<std::string> left_out;  ///< for each combination of settings that makes no case, why
};

/// Throws UserError for a setting that no subcommand of the kinds takes, for identical cases, for combinations that the
/// program refuses (unless they are left out), and for a plan without cases.
Made make(const Spec& spec, const Vocabulary& vocabulary, const Progress& progress = {});

/// Throws UserError (Input) that names `file` and the case unless each case has the steps that make() writes for its
/// kind and settings. Otherwise a plan from elsewhere could run any command.
void require_made(const Plan& plan, const Vocabulary& vocabulary, const std::filesystem::path& file);

}  // namespace fastsplat::plan
