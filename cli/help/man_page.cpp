// SPDX-License-Identifier: Apache-2.0
#include "cli/help/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/version.hpp"
#include "cli/help/exit_codes.hpp"

namespace fastsplat::cli {
namespace {

/// Escaped for roff: no escape, no macro, and minus signs that can be copied.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

/// An argument of a macro, with its spaces kept.
std::string argument(const std::string& text) {
  std::string out = roff(text);
  for (std::size_t at = 0; (at = out.find('"', at)) != out.npos; at += 4) out.replace(at, 1, "\\(dq");
  return "\"" + out + "\"";
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string called(const Description& subcommand) {
  return subcommand.name.empty() ? "fastsplat" : "fastsplat " + subcommand.name;
}

bool belongs_to(const Description& subcommand, const Description& head) {
  return subcommand.name.starts_with(head.name + " ");
}

std::string synopsis(const Description& subcommand, const std::vector<Description>& all) {
  std::string line = bold(called(subcommand));
  for (const Flag& flag : subcommand.flags) {
    if (flag.required && !flag.positional()) line += " " + bold(flag.names.back()) + " " + italic(flag.unit);
  }
  const bool has_flags = std::any_of(subcommand.flags.begin(), subcommand.flags.end(),
                                     [](const Flag& flag) { return !flag.positional(); });
  if (has_flags) line += " [" + italic("flags") + "]";
  for (const Flag& flag : subcommand.flags) {
    if (!flag.positional()) continue;
    const std::string word = italic(flag.names.front()) + (flag.repeatable ? " ..." : "");
    line += flag.required ? " " + word : " [" + word + "]";
  }
  if (subcommand.name.empty()) line += " " + italic("subcommand") + " [" + italic("flags") + "]";
  const bool heads = std::any_of(all.begin(), all.end(), [&](const auto& one) { return belongs_to(one, subcommand); });
  if (subcommand.group && heads) line += " " + italic("subcommand") + " [" + italic("flags") + "]";
  return line + "\n";
}

std::string names_of(const Flag& flag) {
  std::string text;
  for (const auto& name : flag.names) {
    text += text.empty() ? "" : ", ";
    text += flag.positional() ? italic(name) : bold(name);
  }
  return flag.unit.empty() ? text : text + " " + italic(flag.unit);
}

std::string entry(const Flag& flag) {
  std::string text = ".TP\n" + names_of(flag) + "\n" + roff(flag.help) + "\n";
  if (flag.required && !flag.positional()) text += "(required)\n";
  if (flag.repeatable && !flag.positional()) text += "(repeatable)\n";
  const auto names = flag.values ? flag.values() : std::vector<std::string>{};
  if (!names.empty())
    text += fmt::format(".br\nOne of: {}{}\n", roff(fmt::format("{}", fmt::join(names, ", "))),
                        flag.takes_file() ? ", or a file" : "");
  return text;
}

/// Positional arguments first, then the flags under their headings, in the order declared.
std::string options(const Description& subcommand) {
  std::vector<std::string> headings;
  for (const Flag& flag : subcommand.flags) {
    const std::string& heading = flag.positional() ? "" : flag.group;
    if (std::find(headings.begin(), headings.end(), heading) == headings.end()) headings.push_back(heading);
  }
  std::stable_sort(headings.begin(), headings.end(),
                   [](const auto& a, const auto& b) { return a.empty() && !b.empty(); });
  std::string text;
  for (const auto& heading : headings) {
    if (!heading.empty()) text += ".SS " + argument(heading) + "\n";
    for (const Flag& flag : subcommand.flags) {
      if ((flag.positional() ? "" : flag.group) == heading) text += entry(flag);
    }
  }
  return text;
}

std::string examples(const Description& subcommand) {
  std::string text;
  for (const Example& example : subcommand.examples)
    text += ".TP\n" + roff(example.does) + "\n.EX\n" + roff(example.command) + "\n.EE\n";
  return text;
}

std::string subcommands_of(const Description& head, const std::vector<Description>& all) {
  std::string text;
  for (const Description& subcommand : all) {
    if (subcommand.name.empty() || !(head.name.empty() || belongs_to(subcommand, head))) continue;
    text += ".TP\n" + bold(subcommand.name) + "\n" + roff(subcommand.summary) + "\n";
  }
  return text;
}

std::string exit_status() {
  std::string text;
  for (const auto& [code, word, meaning] : kExitMeanings)
    text += fmt::format(".TP\n.B {}\n{}: {}\n", static_cast<int>(code), word, roff(meaning));
  return text;
}

std::string see_also(const Description& subcommand, const std::vector<Description>& all) {
  std::vector<std::string> pages;
  for (const Description& other : all) {
    const bool near =
        subcommand.name.empty() || other.name.empty() || belongs_to(other, subcommand) ||
        belongs_to(subcommand, other) ||
        other.name.substr(0, other.name.find(' ')) == subcommand.name.substr(0, subcommand.name.find(' '));
    if (near && other.name != subcommand.name) pages.push_back(man_page_name(other));
  }
  std::string text;
  for (const auto& page : pages) text += ".BR " + roff(page) + (page == pages.back() ? " (1)\n" : " (1),\n");
  return text;
}

}  // namespace

std::string man_page_name(const Description& subcommand) {
  std::string name = called(subcommand);
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string man_page(const Description& subcommand, const std::vector<Description>& all) {
  std::string title = man_page_name(subcommand);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  std::string text = ".\\\" Made by `fastsplat help --man`; do not edit.\n";
  text += fmt::format(".TH {} 1 \"\" {} \"FastSplat\"\n", argument(title), argument("fastsplat " + program_version()));
  text += ".SH NAME\n" + roff(man_page_name(subcommand)) + " \\- " + roff(subcommand.summary) + "\n";
  text += ".SH SYNOPSIS\n" + synopsis(subcommand, all);
  const auto section = [&](const char* name, const std::string& body) {
    if (!body.empty()) text += fmt::format(".SH {}\n{}", argument(name), body);
  };
  section("EXAMPLES", examples(subcommand));
  section("SUBCOMMANDS", subcommand.name.empty() || subcommand.group ? subcommands_of(subcommand, all) : "");
  section("OPTIONS", options(subcommand));
  section("EXIT STATUS", exit_status());
  section("SEE ALSO", see_also(subcommand, all));
  return text;
}

}  // namespace fastsplat::cli
