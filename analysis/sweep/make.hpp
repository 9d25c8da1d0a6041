// From a specification to a plan: axes crossed, settings put into the commands that take them, cases named.
#pragma once

#include <functional>

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/spec.hpp"

namespace fastsplat::plan {

/// What the program knows and this folder does not: its verbs, and what is behind the names that settings hold.
struct Vocabulary {
  /// "--size", ...; throws UserError (Usage) for a verb that there is none of.
  std::function<std::vector<std::string>(const std::string& verb)> flags_of;
  /// Throws UserError for words, from the verb on, that the program would refuse before it reads a volume.
  std::function<void(const Words& words)> check;
  /// Throws UserError where there is nothing behind a name, or limits between keys are broken.
  std::function<Content(const Settings& settings, const std::vector<std::string>& verbs)> content;
};

struct Made {
  Plan plan;
  std::vector<std::string> left_out;  ///< why, of each combination of settings that makes no case
};

/// Throws UserError for a setting that no verb of the kinds takes, for cases that are the same, for what the program
/// refuses (unless that is left out), and for a plan without cases.
Made make(const Spec& spec, const Vocabulary& vocabulary);

/// A plan is a list of commands, so a file from elsewhere could hold any. UserError (Input) naming `file` and the case
/// unless the steps of each case are what make() writes for its kind and its settings.
void require_made(const Plan& plan, const Vocabulary& vocabulary, const std::filesystem::path& file);

}  // namespace fastsplat::plan
