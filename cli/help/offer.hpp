// SPDX-License-Identifier: Apache-2.0
// Completions that a shell offers for a value, and quoting for the shells' scripts.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

struct Offer {
  std::vector<std::string> words;
  bool files = false, folders = false;

  bool nothing() const { return words.empty() && !files && !folders; }
  /// Whether some word is a prefix such as "radial.entries=" or "every-", which no space may follow.
  bool goes_on() const;
  bool operator==(const Offer&) const = default;
};

Offer offer_of(const Flag& flag);
/// Of all positional arguments of a subcommand together.
Offer offer_of_words(const Description& subcommand);

/// Whether subcommands "NAME ..." exist.
bool has_inner(const Description& subcommand, const std::vector<Description>& all);
/// "record" for "stream record".
std::string last_word(const std::string& name);
/// The subcommands "HEAD x" of `head`; for the program, those of one word.
std::vector<const Description*> inner_of(const Description& head, const std::vector<Description>& all);

std::string bash_script(const std::vector<Description>& all);
std::string zsh_script(const std::vector<Description>& all);
std::string fish_script(const std::vector<Description>& all);

}  // namespace fastsplat::cli
