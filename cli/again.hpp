// The command that makes a result again: every result carries its own.
#pragma once

#include <span>
#include <string>

namespace fastsplat::cli {

/// `fastsplat WORDS...` without what changes no result: --json, --quiet, --threads.
std::string command_text(std::span<const std::string> words);

/// Of this process; `parse` tells it once, before any verb runs.
void remember_command(std::span<const std::string> words);
const std::string& command_again();

}  // namespace fastsplat::cli
