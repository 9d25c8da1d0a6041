// SPDX-License-Identifier: Apache-2.0
// Completion scripts: all subcommands, flags and value names; the shell does not run the program to complete.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

/// "bash", "zsh", "fish".
const std::vector<std::string>& completion_shells();

/// The script for `shell`. `all`: all subcommands, the program's own description first.
std::string completion_script(const std::string& shell, const std::vector<Description>& all);

}  // namespace fastsplat::cli
