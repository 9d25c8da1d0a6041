// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/outcome.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "analysis/sweep/run.hpp"
#include "base/json_file.hpp"
#include "base/machine_error.hpp"
#include "base/read_file.hpp"

namespace fastsplat::plan {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kMostOutcomeBytes = std::size_t{1} << 28;

Json read_json(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return nullptr;
  Json json = parse_json<Json>(read_text_file(path, kMostOutcomeBytes));
  fs::remove(path, ignored);
  return json;
}

/// Explains exit code 1: the broken limits of `compare`, the mismatches of `verify`.
std::string why_failed(const Json& json, const std::string& subcommand) {
  std::string text;
  if (json.is_object() && json.contains("limits") && json["limits"].is_array()) {
    for (const Json& limit : json["limits"]) {
      if (limit.value("ok", true)) continue;
      text += fmt::format("{}{} {}, limit {}", text.empty() ? "" : ", ", limit.value("name", "?"),
                          limit.value("got", Json()).dump(), limit.value("limit", Json()).dump());
    }
  }
  if (json.is_object() && json.value("mismatches", Json()).is_number() && json["mismatches"] != 0)
    text = fmt::format("{} mismatches", json["mismatches"].dump());
  return text.empty() ? fmt::format("`{}` ended with exit code 1", subcommand) : subcommand + ": " + text;
}

}  // namespace

Outcome outcome_of(const Step& step, const Ended& ended, const Places& places) {
  Outcome out{.exit_code = ended.exit_code, .message = {}, .json = {}, .coverage = {}};
  const std::string subcommand = step.result.empty() ? step.words.front() : step.result;
  const std::vector<std::string> folders{places.folder.string(), places.shared.string()};
  std::string missing;
  try {
    if (!step.result.empty()) out.json = read_json(places.folder / kJson);
    if (step.coverage) out.coverage = read_json(places.folder / "coverage.json");
    if (!step.shared.empty() && !fs::exists(places.folder / step.shared)) missing = step.shared;
    if (!step.result.empty() && out.json.is_null()) missing = "JSON";
  } catch (const std::exception& error) {
    missing = fmt::format("readable JSON ({})", error.what());
  }
  forget_surroundings(out.json, folders);
  const bool finished =
      ended.exit_code == static_cast<int>(ExitCode::Pass) || ended.exit_code == static_cast<int>(ExitCode::Failed);
  out.accident = ended.exit_code > static_cast<int>(ExitCode::Simulation) || (finished && !missing.empty());
  const std::string said = ended.message.empty() ? fmt::format("exit code {}", ended.exit_code) : ended.message;
  if (ended.signal != 0) {
    out.message = fmt::format("`{}` was ended by signal {}", subcommand, ended.signal);
  } else if (!finished) {
    out.message = fmt::format("`{}`: {}", subcommand, said);
  } else if (!missing.empty()) {
    out.message = fmt::format("`{}` ended with exit code {} without {}", subcommand, ended.exit_code, missing);
  } else if (ended.exit_code != 0) {
    out.message = why_failed(out.json, subcommand);
  }
  out.status = out.message.empty() ? Status::Pass : finished && missing.empty() ? Status::Fail : Status::Error;
  out.message = forget_surroundings(out.message, folders);
  return out;
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    throw_machine({.where = path.string(),
                   .what = std::string("cannot write: ") + std::strerror(errno),
                   .expected = {},
                   .got = {},
                   .fix = "choose a folder with enough free space (--results)"});
  }
}

}  // namespace fastsplat::plan
