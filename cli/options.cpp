#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace fastsplat::cli {

void Options::flag(const char* name, bool& to, const char* help) { verb_.add_flag(name, to, help)->group(group_); }

void Options::words(const char* name, std::vector<std::string>& to, const char* unit, const char* help) {
  verb_.add_option(name, to, help)->allow_extra_args(false)->type_name(unit)->group(group_);
}

void Options::value(const char* name, Problem problem, Take take, const char* unit, const char* help) {
  CLI::Option* option = verb_.add_option_function<std::string>(name, std::move(take), help);
  if (problem) option->check(CLI::Validator(std::move(problem), ""));
  option->type_name(unit)->group(group_);
}

void Options::positional(const char* name, std::string& to, const char* help) {
  verb_.add_option(name, to, help)->required();
}

void Options::positionals(const char* name, std::vector<std::string>& to, int least, const char* help) {
  verb_.add_option(name, to, help)->expected(least, 1 << 20)->required(least > 0);
}

void Options::required(const char* name, std::string& to, const char* unit, const char* help) {
  verb_.add_option(name, to, help)->required()->type_name(unit)->group(group_);
}

void Options::example(const std::string& command) { verb_.footer("Example: " + command); }

Options::Problem Options::one_of(const std::vector<std::string>& names) {
  return [names](const std::string& text) -> std::string {
    if (std::find(names.begin(), names.end(), text) != names.end()) return {};
    return fmt::format("expected {}, got '{}'", fmt::join(names, " or "), text);
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
