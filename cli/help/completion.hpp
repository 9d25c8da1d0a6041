// Completion scripts: every verb, flag and name of a value, for the shell to know without asking the program.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

/// "bash", "zsh", "fish".
const std::vector<std::string>& completion_shells();

/// The script for one of them; `all`: every verb, the program's own description first.
std::string completion_script(const std::string& shell, const std::vector<Description>& all);

}  // namespace fastsplat::cli
