// What a shell may offer for a value, and words as its scripts hold them.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

struct Offer {
  std::vector<std::string> words;
  bool files = false, folders = false;

  bool nothing() const { return words.empty() && !files && !folders; }
  /// Some word is only a beginning, "radial.entries=", "every-": no space may follow it.
  bool goes_on() const;
  bool operator==(const Offer&) const = default;
};

Offer offer_of(const Flag& flag);
/// Of all of a verb's words without a flag together.
Offer offer_of_words(const Description& verb);

/// Whether verbs "NAME ..." follow this one.
bool has_inner(const Description& verb, const std::vector<Description>& all);
/// "record" of "stream record".
std::string last_word(const std::string& name);
/// The verbs "HEAD x" of `head`, or those of one word where it is the program.
std::vector<const Description*> inner_of(const Description& head, const std::vector<Description>& all);

std::string bash_script(const std::vector<Description>& all);
std::string zsh_script(const std::vector<Description>& all);
std::string fish_script(const std::vector<Description>& all);

}  // namespace fastsplat::cli
