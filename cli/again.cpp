#include "cli/again.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace fastsplat::cli {
namespace {

std::string& remembered() {
  static std::string command;
  return command;
}

}  // namespace

std::string shell_word(const std::string& word) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+,=:@%", c) != nullptr; };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

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

const std::string& command_again() { return remembered(); }

}  // namespace fastsplat::cli
