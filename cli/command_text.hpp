// SPDX-License-Identifier: Apache-2.0
// The command line that reproduces a result; results carry it as "command".
#pragma once

#include <span>
#include <string>

namespace fastsplat::cli {

/// `fastsplat WORDS...` without --json, --quiet and --threads, which change no result.
std::string command_text(std::span<const std::string> words);

/// Stores the command of this process, or of a fork of it, before the subcommand runs.
void remember_command(std::span<const std::string> words);
const std::string& this_command();

}  // namespace fastsplat::cli
