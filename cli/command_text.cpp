// SPDX-License-Identifier: Apache-2.0
#include "cli/command_text.hpp"

#include "base/shell_word.hpp"

namespace fastsplat::cli {
namespace {

std::string& remembered() {
  static std::string command;
  return command;
}

}  // namespace

std::string command_text(std::span<const std::string> words) {
  std::string text = "fastsplat";
  for (std::size_t at = 0; at < words.size(); ++at) {
    const std::string& word = words[at];
    if (word == "--quiet" || word.starts_with("--json=") || word.starts_with("--threads=")) continue;
    if (word == "--json" || word == "--threads") {
      ++at;
      continue;
    }
    text += " " + shell_word(word);
  }
  return text;
}

void remember_command(std::span<const std::string> words) { remembered() = command_text(words); }

const std::string& this_command() { return remembered(); }

}  // namespace fastsplat::cli
