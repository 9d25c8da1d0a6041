// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>

#include "base/shell_word.hpp"
#include "cli/help/offer.hpp"

namespace fastsplat::cli {
namespace {

// Splits the line itself, because bash breaks words at = and :, which occur in values.
const char* const kHead = R"(# bash completion of fastsplat, made by `fastsplat completion bash`; do not edit.
# For one session: source <(fastsplat completion bash)

# Offers of $words, files where $files is set, folders where $folders is, what begins with $1.
_fastsplat_offer() {
  local breaks='' kept='' reply
  # What lies before the last = or : is on the line already, where bash breaks words there.
  [[ $COMP_WORDBREAKS == *=* ]] && breaks+='='
  [[ $COMP_WORDBREAKS == *:* ]] && breaks+=':'
  [[ -n $breaks ]] && kept=${1%"${1##*["$breaks"]}"}
  COMPREPLY=()
  while IFS= read -r reply; do [[ -n $reply ]] && COMPREPLY+=("${reply#"$kept"}"); done < <(compgen -W "$words" -- "$1")
  # File names keep their spaces; only what stands behind a flag's = is completed as a name.
  if [[ -n $files ]]; then
    compopt -o filenames 2>/dev/null
    while IFS= read -r reply; do COMPREPLY+=("$reply"); done < <(compgen -f -- "$1")
  elif [[ -n $folders ]]; then
    compopt -o filenames 2>/dev/null
    while IFS= read -r reply; do COMPREPLY+=("$reply"); done < <(compgen -d -- "$1")
  fi
  if (( ${#COMPREPLY[@]} == 1 )) && [[ ${COMPREPLY[0]} == *[=-] && ${COMPREPLY[0]} != --* || ${COMPREPLY[0]} == --*= ]]; then
    compopt -o nospace 2>/dev/null
  fi
}

)";

const char* const kBody = R"(
_fastsplat() {
  local line=${COMP_LINE:0:COMP_POINT} words='' files='' folders='' flags='' inner='' names='' name_files='' name_folders=''
  local verb='' last cur help=''
  local -a typed
  read -ra typed <<<"$line"
  [[ $line == *[[:space:]] || ${#typed[@]} -eq 0 ]] && typed+=("")
  if [[ ${typed[1]} == help && ${#typed[@]} -gt 2 && ${typed[2]} != -* ]]; then
    help=1
    typed=("${typed[0]}" "${typed[@]:2}")
  fi
  last=$(( ${#typed[@]} - 1 ))
  cur=${typed[last]}
  if (( last > 1 )); then
    verb=${typed[1]}
    (( last > 2 )) && _fastsplat_verb "$verb ${typed[2]}" && verb+=" ${typed[2]}"
  fi
  COMPREPLY=()
  _fastsplat_of "$verb"
  if [[ -n $help && $cur != -* ]]; then
    words=$inner
    _fastsplat_offer "$cur"
    return
  fi
  # A value: behind its flag and a space, or behind its flag and =.
  if [[ $cur == --*=* ]]; then
    if _fastsplat_value "$verb" "${cur%%=*}"; then _fastsplat_offer "${cur#*=}"; fi
    # Without = among bash's breaks the flag is part of what is replaced.
    if [[ $COMP_WORDBREAKS != *=* ]]; then COMPREPLY=("${COMPREPLY[@]/#/${cur%%=*}=}"); fi
    return
  fi
  if (( last > 1 )) && _fastsplat_value "$verb" "${typed[last-1]}"; then
    _fastsplat_offer "$cur"
    return
  fi
  if [[ $cur == -* ]]; then
    words=$flags files='' folders=''
  elif [[ -n $inner && ( $last -eq 1 || ( $last -eq 2 && $verb == "${typed[1]}" ) ) ]]; then
    words=$inner files='' folders=''
  else
    words=$names files=$name_files folders=$name_folders
  fi
  _fastsplat_offer "$cur"
}

complete -F _fastsplat fastsplat
)";

std::string quoted_list(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return shell_word(text);
}

/// Generates the function that sets a subcommand's completions: flags, nested subcommands, positional arguments.
std::string subcommands_function(const std::vector<Description>& all) {
  std::string text = "_fastsplat_of() {\n  inner='' names='' name_files='' name_folders='' flags=''\n  case $1 in\n";
  for (const Description& subcommand : all) {
    std::vector<std::string> flags, inner;
    for (const Flag& flag : subcommand.flags) {
      if (!flag.positional()) flags.insert(flags.end(), flag.names.begin(), flag.names.end());
    }
    for (const char* help : {"-h", "--help"}) flags.emplace_back(help);
    for (const Description* one : inner_of(subcommand, all)) inner.push_back(last_word(one->name));
    const Offer names = offer_of_words(subcommand);
    text += fmt::format("    {})\n      flags={}\n", subcommand.name.empty() ? "''" : shell_word(subcommand.name),
                        quoted_list(flags));
    if (!inner.empty()) text += fmt::format("      inner={}\n", quoted_list(inner));
    if (!names.words.empty()) text += fmt::format("      names={}\n", quoted_list(names.words));
    if (names.files) text += "      name_files=1\n";
    if (names.folders) text += "      name_folders=1\n";
    text += "      ;;\n";
  }
  text += "  esac\n}\n\n";
  std::string inner;
  for (const Description& subcommand : all) {
    if (subcommand.name.find(' ') != subcommand.name.npos)
      inner += (inner.empty() ? "" : " | ") + shell_word(subcommand.name);
  }
  return text + "_fastsplat_verb() { case $1 in " + inner + ") return 0 ;; esac; return 1; }\n";
}

/// Generates the function that returns whether flag $2 of subcommand $1 takes a value and sets its completions. Most
/// flags mean the same in all subcommands that have them; these appear once.
std::string values_function(const std::vector<Description>& all) {
  struct Use {
    std::string subcommand;
    Offer offer;
  };
  std::vector<std::string> order;
  std::map<std::string, std::vector<Use>> uses;
  std::map<std::string, int> having;
  for (const Description& subcommand : all) {
    for (const Flag& flag : subcommand.flags) {
      if (flag.positional()) continue;
      for (const auto& name : flag.names) {
        ++having[name];
        if (!flag.takes_value()) continue;
        if (!uses.contains(name)) order.push_back(name);
        uses[name].push_back({subcommand.name, offer_of(flag)});
      }
    }
  }
  std::vector<std::pair<Offer, std::vector<std::string>>> cases;
  const auto add = [&](const Offer& offer, const std::string& pattern) {
    for (auto& [known, patterns] : cases) {
      if (known == offer) return patterns.push_back(pattern);
    }
    cases.push_back({offer, {pattern}});
  };
  for (const auto& name : order) {
    const auto& in = uses[name];
    bool same = static_cast<int>(in.size()) == having[name];
    for (const Use& use : in) same = same && use.offer == in.front().offer;
    if (same) {
      add(in.front().offer, "*' " + name + "'");
    } else {
      for (const Use& use : in) add(use.offer, shell_word(use.subcommand + " " + name));
    }
  }
  std::string text = "\n_fastsplat_value() {\n  case \"$1 $2\" in\n";
  for (const auto& [offer, patterns] : cases) {
    text += fmt::format("    {})\n", fmt::join(patterns, " | "));
    if (!offer.words.empty()) text += fmt::format("      words={}\n", quoted_list(offer.words));
    if (offer.files) text += "      files=1\n";
    if (offer.folders) text += "      folders=1\n";
    text += "      ;;\n";
  }
  return text + "    *) return 1 ;;\n  esac\n}\n";
}

}  // namespace

std::string bash_script(const std::vector<Description>& all) {
  return kHead + subcommands_function(all) + values_function(all) + kBody;
}

}  // namespace fastsplat::cli
