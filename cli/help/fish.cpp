// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/help/offer.hpp"

namespace fastsplat::cli {
namespace {

const char* const kFishHead = R"(# fish completion of fastsplat, made by `fastsplat completion fish`; do not edit.
# For one session: fastsplat completion fish | source

# Whether the verb typed so far is just what is given: none, "render", "stream record".
function __fastsplat_at
    set -l typed (commandline -opc)
    set -l verb $typed[2]
    if test (count $typed) -ge 3; and contains -- "$typed[2] $typed[3]" $__fastsplat_inner
        set verb "$typed[2] $typed[3]"
    end
    test "$verb" = "$argv"
end

# ... and nothing else was typed behind it.
function __fastsplat_just
    test (count (commandline -opc)) -eq (math (count $argv) + 1); and __fastsplat_at $argv
end

)";

/// Single-quoted for fish, which then interprets only \\ and \'.
std::string in_quotes(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\\' || c == '\'') out += '\\';
    out += c;
  }
  return out + "'";
}

/// The words as one quoted list: -a expands it and splits it at spaces.
std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return in_quotes(text);
}

std::string value(const Offer& offer) {
  std::string text = offer.files ? " -r -F" : " -x";
  if (offer.folders) return text + " -a '(__fish_complete_directories)'";
  return offer.words.empty() ? text : text + " -a " + list(offer.words);
}

std::string line(const std::string& condition, const std::string& rest) {
  return "complete -c fastsplat -n " + in_quotes(condition) + rest + "\n";
}

std::string at(const Description& subcommand) {
  return subcommand.name.empty() ? "__fastsplat_at" : "__fastsplat_at " + subcommand.name;
}

std::string flag_line(const Description& subcommand, const Flag& flag) {
  std::string text;
  for (const auto& name : flag.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (flag.takes_value()) text += value(offer_of(flag));
  return line(at(subcommand), text + " -d " + in_quotes(flag.help));
}

}  // namespace

std::string fish_script(const std::vector<Description>& all) {
  std::string text = kFishHead;
  text += "set -g __fastsplat_inner";
  for (const Description& subcommand : all) {
    if (subcommand.name.find(' ') != subcommand.name.npos) text += " " + in_quotes(subcommand.name);
  }
  text += "\n\n# No files but where they make sense.\ncomplete -c fastsplat -f\n";
  for (const Description& subcommand : all) {
    text += "\n";
    for (const Description* inner : inner_of(subcommand, all)) {
      text += line("__fastsplat_just" + (subcommand.name.empty() ? "" : " " + subcommand.name),
                   " -a " + last_word(inner->name) + " -d " + in_quotes(inner->summary));
    }
    for (const Flag& flag : subcommand.flags) {
      if (!flag.positional()) text += flag_line(subcommand, flag);
    }
    text += line(at(subcommand), " -s h -l help -d 'help'");
    const Offer words = offer_of_words(subcommand);
    if (words.files) text += line(at(subcommand), " -F");
    if (!words.words.empty()) text += line(at(subcommand), " -a " + list(words.words));
  }
  return text;
}

}  // namespace fastsplat::cli
