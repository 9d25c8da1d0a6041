// SPDX-License-Identifier: Apache-2.0
#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <initializer_list>
#include <sstream>

#include "base/suggest.hpp"

namespace fastsplat::cli {

namespace {

bool names_any(const std::string& unit, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return unit.find(word) != unit.npos; });
}

}  // namespace

bool Flag::takes_file() const {
  // A positional argument may be a file unless all its values are known.
  return positional() ? !only_values : names_any(unit, {"FILE", "PATH", "PREFIX"});
}
bool Flag::takes_folder() const { return names_any(unit, {"FOLDER"}); }

Options::Options(CLI::App& subcommand) : subcommand_(subcommand) {
  for (const CLI::App* app = &subcommand; app->get_parent() != nullptr; app = app->get_parent())
    description_.name = app->get_name() + (description_.name.empty() ? "" : " " + description_.name);
  description_.summary = subcommand.get_description();
}

void Options::describe(const char* name, const char* unit, const char* help, bool required, bool repeatable) {
  Flag flag{.names = {}, .unit = unit, .help = help, .group = group_, .required = required, .repeatable = repeatable};
  std::istringstream names(name);
  for (std::string one; std::getline(names, one, ',');) flag.names.push_back(one);
  description_.flags.push_back(std::move(flag));
}

void Options::flag(const char* name, bool& to, const char* help) {
  describe(name, "", help, false, false);
  subcommand_.add_flag(name, to, help)->group(group_);
}

void Options::words(const char* name, std::vector<std::string>& to, const char* unit, const char* help) {
  describe(name, unit, help, false, true);
  subcommand_.add_option(name, to, help)->allow_extra_args(false)->type_name(unit)->group(group_);
}

void Options::value(const char* name, Problem problem, Take take, const char* unit, const char* help) {
  describe(name, unit, help, false, false);
  CLI::Option* option = subcommand_.add_option_function<std::string>(name, std::move(take), help);
  if (problem) option->check(CLI::Validator(std::move(problem), ""));
  option->type_name(unit)->group(group_);
}

void Options::positional(const char* name, std::string& to, const char* help) {
  describe(name, "", help, true, false);
  subcommand_.add_option(name, to, help)->required();
}

void Options::positionals(const char* name, std::vector<std::string>& to, int least, const char* help) {
  describe(name, "", help, least > 0, true);
  subcommand_.add_option(name, to, help)->expected(least, 1 << 20)->required(least > 0);
}

void Options::required(const char* name, std::string& to, const char* unit, const char* help) {
  describe(name, unit, help, true, false);
  subcommand_.add_option(name, to, help)->required()->type_name(unit)->group(group_);
}

void Options::example(const std::string& command, const std::string& does, Example::Speed speed) {
  description_.examples.push_back({command, does, speed});
}

Options::Problem Options::one_of(const std::vector<std::string>& names) {
  return [names](const std::string& text) -> std::string {
    if (std::find(names.begin(), names.end(), text) != names.end()) return {};
    const std::string meant = did_you_mean(text, names);
    return fmt::format("expected {}, got '{}'{}", fmt::join(names, " or "), text, meant.empty() ? "" : "; " + meant);
  };
}

Options::Problem Options::within(long low, long high) {
  return [low, high](const std::string& text) -> std::string {
    const auto value = integer_from<long>(text);
    if (value && *value >= low && *value <= high) return {};
    return fmt::format("expected an integer from {} to {}, got '{}'", low, high, text);
  };
}

Options::Problem Options::finite() {
  return [](const std::string& text) {
    return number_from(text) ? std::string{} : "expected a finite number, got '" + text + "'";
  };
}

}  // namespace fastsplat::cli
