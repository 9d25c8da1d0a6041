// From words to the verb that was meant.
#pragma once

#include <string>
#include <vector>

#include "cli/verb.hpp"

namespace fastsplat::cli {

/// Whatever makes no sense is a UserError (Usage) with the fix. --help, --version and `help` print.
Action parse(int argc, const char* const* argv, const std::vector<Verb>& verbs = all_verbs());

/// Every long flag of a verb, "--size"; UserError (Usage) where there is no such verb.
std::vector<std::string> flags_of(const std::string& verb, const std::vector<Verb>& verbs = all_verbs());

}  // namespace fastsplat::cli
