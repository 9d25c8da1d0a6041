// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/shell_word.hpp"
#include "cli/help/offer.hpp"

namespace fastsplat::cli {
namespace {

/// Escaped for a specification of _arguments.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c != '\0' && std::strchr("\\[]:", c) != nullptr) out += '\\';
    out += c;
  }
  return out;
}

/// A word of _describe's list, separated from its explanation by a colon.
std::string described(const std::string& word, const std::string& what) { return shell_word(plain(word) + ":" + what); }

std::string function_of(const Description& subcommand) {
  std::string name = "_fastsplat" + std::string(subcommand.name.empty() ? "" : "_") + subcommand.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// Functions that offer a value's names, one per distinct list.
class Lists {
 public:
  /// The command that _arguments runs for `offer`.
  std::string action(const Offer& offer) {
    if (offer.words.empty()) return offer.files ? "_files" : offer.folders ? "_files -/" : " ";
    for (std::size_t at = 0; at < offers_.size(); ++at) {
      if (offers_[at] == offer) return name(at);
    }
    offers_.push_back(offer);
    return name(offers_.size() - 1);
  }
  std::string functions() const {
    std::string text;
    for (std::size_t at = 0; at < offers_.size(); ++at) {
      const Offer& offer = offers_[at];
      text += name(at) + "() {\n  local -a names=(";
      for (const auto& word : offer.words) text += "\n    " + shell_word(word);
      text += fmt::format("\n  )\n  compadd {}-a names\n", offer.goes_on() ? "-S '' " : "");
      if (offer.files) text += "  _files\n";
      if (offer.folders) text += "  _files -/\n";
      text += "}\n\n";
    }
    return text;
  }

 private:
  static std::string name(std::size_t at) { return fmt::format("_fastsplat__names{}", at + 1); }
  std::vector<Offer> offers_;
};

std::string specification(const Flag& flag, Lists& lists) {
  const std::string action = lists.action(offer_of(flag));
  if (flag.positional()) {
    return shell_word((flag.repeatable ? "*"
                       : flag.required ? ""
                                       : ":") +
                      (":" + plain(flag.names.front())) + ":" + action);
  }
  const std::string value = flag.takes_value() ? ":" + plain(flag.unit) + ":" + action : "";
  std::string text;
  std::string exclusive;
  for (const auto& name : flag.names) exclusive += (exclusive.empty() ? "" : " ") + name;
  for (const auto& name : flag.names) {
    const char* joined = !flag.takes_value() ? "" : name.starts_with("--") ? "=" : "+";
    const std::string front = flag.repeatable ? "*" : "(" + exclusive + ")";
    text += (text.empty() ? "" : " ") + shell_word(front + name + joined + "[" + plain(flag.help) + "]" + value);
  }
  return text;
}

std::string inner_choice(const Description& subcommand, const std::vector<Description>& all,
                         const std::string& otherwise) {
  std::string text = "  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then\n    local -a verbs=(\n";
  for (const Description* one : inner_of(subcommand, all))
    text += "      " + described(last_word(one->name), one->summary) + "\n";
  text += "    )\n    _describe -t verbs verb verbs\n";
  if (!otherwise.empty()) text += "    " + otherwise + "\n";
  text += "    return\n  fi\n  case $words[2] in\n";
  for (const Description* one : inner_of(subcommand, all)) {
    text += fmt::format("    {})\n      shift words; (( CURRENT-- ))\n      {}\n      return\n      ;;\n",
                        shell_word(last_word(one->name)), function_of(*one));
  }
  return text + "  esac\n";
}

std::string function(const Description& subcommand, const std::vector<Description>& all, Lists& lists) {
  std::string text = function_of(subcommand) + "() {\n";
  if (has_inner(subcommand, all)) text += inner_choice(subcommand, all, "");
  text += "  _arguments -s -S";
  for (const Flag& flag : subcommand.flags) text += " \\\n    " + specification(flag, lists);
  return text + " \\\n    " + shell_word("(-h --help)-h[help]") + " \\\n    " + shell_word("(-h --help)--help[help]") +
         "\n}\n\n";
}

}  // namespace

std::string zsh_script(const std::vector<Description>& all) {
  Lists lists;
  std::string functions;
  for (const Description& subcommand : all) functions += function(subcommand, all, lists);
  return "#compdef fastsplat\n"
         "# zsh completion of fastsplat, made by `fastsplat completion zsh`; do not edit.\n"
         "# In a folder of $fpath it is called _fastsplat. For one session: source <(fastsplat completion zsh)\n\n" +
         lists.functions() + functions +
         "# Autoloaded, it is called; read as a file, it makes itself known.\n"
         "if [[ $funcstack[1] == _fastsplat ]]; then\n  _fastsplat \"$@\"\nelse\n  compdef _fastsplat fastsplat\nfi\n";
}

}  // namespace fastsplat::cli
