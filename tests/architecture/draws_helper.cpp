// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/draws_helper.hpp"

#include <regex>

namespace fastsplat::architecture {
namespace {

/// The contents of open brackets. Arguments have no order; braces and statements have one.
struct Open {
  bool arguments = false;
  bool drawn = false;    ///< since the last token that orders
  bool earlier = false;  ///< in an argument before
  bool any = false, statements = false;
  bool draw = false;  ///< the arguments of a draw: evaluated before it
};

}  // namespace

std::vector<std::string> draw_offences(const std::vector<SourceFile>& files, int& draws) {
  // A statement that encloses others, a generator by its usual names, or a token that orders or encloses.
  static const std::regex token(
      R"(\b(?:if|for|while|switch) ?\(|\b(?:uniform|(?:random_?|rng|r)\.(?:next|between|chance|once_in|one_of|unit|below))\(|\n|&&|\|\||<<|>>|[(){}\[\],;?:=])");
  std::vector<std::string> offences;
  for (const SourceFile& file : files) {
    const std::string text = without_comments(file.text);
    std::vector<Open> open(1);
    int line = 1;
    const auto draws_here = [&] {
      Open& here = open.back();
      if (here.drawn || here.earlier)
        offences.push_back(file.path + ":" + std::to_string(line) + ": two draws in no defined order");
      here.drawn = here.any = true;
    };
    for (std::sregex_iterator match(text.begin(), text.end(), token), end; match != end; ++match) {
      const std::string sign = match->str();
      if (sign == "\n") {
        ++line;
      } else if (sign.starts_with("if") || sign.starts_with("for") || sign.starts_with("while") ||
                 sign.starts_with("switch")) {
        open.push_back({.statements = true});
      } else if (sign.size() > 1 && sign.back() == '(') {
        ++draws;
        draws_here();
        open.push_back({.arguments = true, .draw = true});
      } else if (sign == "(" || sign == "[" || sign == "{") {
        open.push_back({.arguments = sign == "("});
      } else if (sign == ")" || sign == "]" || sign == "}") {
        const Open closed = open.back();
        if (open.size() > 1) open.pop_back();
        // The body of a lambda or a block draws when it runs, not where it is written.
        if (closed.any && !closed.draw && !closed.statements) draws_here();
        if (closed.statements) open.back().drawn = false;
      } else {
        Open& here = open.back();
        if (sign == "," && here.arguments) here.earlier = here.earlier || here.any;
        if (sign == ";") here.statements = true;
        here.drawn = false;
      }
    }
  }
  return offences;
}

}  // namespace fastsplat::architecture
