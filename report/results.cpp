// SPDX-License-Identifier: Apache-2.0
#include "report/results.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/json_file.hpp"
#include "base/read_file.hpp"
#include "base/suggest.hpp"
#include "report/verdicts.hpp"

namespace fastsplat::report {
namespace {

/// Larger than any merged plan.
constexpr std::size_t kLargest = std::size_t{256} << 20;

JsonKind a_result() {
  return {.what = "not a result",
          .expected = "a file written by fastsplat with --json",
          .fix = "use --picture ROLE=FILE for pictures",
          .most_bytes = kLargest};
}

/// Old results of `compare` have a schema instead of a subcommand; coverage files of `verify --coverage` have a format.
std::string subcommand_in(const Json& json) {
  const auto text = [&](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string{};
  };
  if (json.contains("verb")) return text("verb");
  if (text("format") == "fastsplat coverage 1") return "coverage";
  return text("schema") == "fastsplat.compare/1" ? "compare" : "";
}

}  // namespace

Result read_result(const std::filesystem::path& file) {
  require_readable_file(file);
  Result result = from_json_file<Json>(file, a_result(), [&](Json json) {
    if (!json.is_object()) throw std::runtime_error(std::string("a JSON ") + json.type_name());
    std::string subcommand = subcommand_in(json);
    if (subcommand.empty()) throw std::runtime_error("an object without a \"verb\"");
    return Result{.file = file, .subcommand = std::move(subcommand), .json = std::move(json)};
  });
  const auto known = reported_subcommands();
  if (std::find(known.begin(), known.end(), result.subcommand) == known.end()) {
    throw_input({.where = file.string(),
                 .what = "verb '" + result.subcommand + "' is not supported in reports",
                 .expected = {},
                 .got = {},
                 .fix = suggestion(result.subcommand, known)});
  }
  reading(result, [&] { verdict_of(result); });  // checks that its figures exist
  return result;
}

std::vector<std::string> reported_subcommands() {
  std::vector<std::string> names;
  for (const auto& [name, unused] : verdicts()) names.push_back(name);
  return names;
}

const char* to_string(Status status) {
  switch (status) {
    case Status::Pass:
      return "pass";
    case Status::Fail:
      return "fail";
    case Status::Error:
      return "error";
    case Status::Measured:
      return "none";
  }
  return "";
}

Verdict verdict_of(const Result& result) { return verdicts().at(result.subcommand)(Figures(result)); }

Verdict verdict_of(const std::vector<Verdict>& all) {
  const auto severity = [](const Verdict& verdict) {
    switch (verdict.status) {
      case Status::Error:
        return 3;
      case Status::Fail:
        return 2;
      case Status::Pass:
        return 1;
      case Status::Measured:
        return 0;
    }
    return 0;
  };
  // max_element: the first of equals.
  return *std::max_element(all.begin(), all.end(),
                           [&](const Verdict& a, const Verdict& b) { return severity(a) < severity(b); });
}

std::string name_of(const Result& result) { return result.shown.empty() ? result.file.string() : result.shown; }

std::string command_of(const Result& result) {
  const auto found = result.json.find("command");
  return found != result.json.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

}  // namespace fastsplat::report
