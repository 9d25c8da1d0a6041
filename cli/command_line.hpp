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

/// The help on the verb that `words` name, on the program where there are none. Words that name none are a UserError
/// (Usage).
std::string help_on(const std::vector<std::string>& words, const std::vector<Verb>& verbs = all_verbs());

/// All that the verbs declare, the program's own flags first, then the order of `verbs`.
std::vector<Description> describe(const std::vector<Verb>& verbs = all_verbs());

/// The one of `all` that `words` name, the program where there are none; UserError (Usage) where there is none.
const Description& described(const std::vector<std::string>& words, const std::vector<Description>& all);

}  // namespace fastsplat::cli
