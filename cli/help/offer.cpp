// SPDX-License-Identifier: Apache-2.0
#include "cli/help/offer.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "cli/help/completion.hpp"

namespace fastsplat::cli {

bool Offer::goes_on() const {
  return std::any_of(words.begin(), words.end(),
                     [](const std::string& word) { return word.ends_with('=') || word.ends_with('-'); });
}

Offer offer_of(const Flag& flag) {
  return {.words = flag.values ? flag.values() : std::vector<std::string>{},
          .files = flag.takes_file(),
          .folders = flag.takes_folder()};
}

Offer offer_of_words(const Description& subcommand) {
  Offer all;
  for (const Flag& flag : subcommand.flags) {
    if (!flag.positional()) continue;
    const Offer one = offer_of(flag);
    for (const auto& word : one.words) {
      if (std::find(all.words.begin(), all.words.end(), word) == all.words.end()) all.words.push_back(word);
    }
    all.files = all.files || one.files;
    all.folders = all.folders || one.folders;
  }
  return all;
}

std::string last_word(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

std::vector<const Description*> inner_of(const Description& head, const std::vector<Description>& all) {
  std::vector<const Description*> inner;
  for (const Description& subcommand : all) {
    const auto space = subcommand.name.rfind(' ');
    const std::string parent = space == subcommand.name.npos ? "" : subcommand.name.substr(0, space);
    if (!subcommand.name.empty() && parent == head.name) inner.push_back(&subcommand);
  }
  return inner;
}

bool has_inner(const Description& subcommand, const std::vector<Description>& all) {
  return !inner_of(subcommand, all).empty();
}

const std::vector<std::string>& completion_shells() {
  static const std::vector<std::string> shells{"bash", "zsh", "fish"};
  return shells;
}

std::string completion_script(const std::string& shell, const std::vector<Description>& all) {
  if (shell == "bash") return bash_script(all);
  if (shell == "zsh") return zsh_script(all);
  if (shell == "fish") return fish_script(all);
  throw_usage({.where = "completion",
               .what = "no script for this shell",
               .expected = "bash, zsh or fish",
               .got = "'" + shell + "'",
               .fix = suggestion(shell, completion_shells())});
}

}  // namespace fastsplat::cli
