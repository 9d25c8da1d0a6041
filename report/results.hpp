// SPDX-License-Identifier: Apache-2.0
// The input of a report: reads and identifies the subcommands' JSON results.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fastsplat::report {

using Json = nlohmann::ordered_json;

struct Result {
  std::filesystem::path file;  ///< as the user named it
  std::string subcommand;      ///< "compare", "errors bound"
  Json json;                   ///< the complete object
  std::string shown = {};      ///< its name in a report, without folders; empty: `file`
};

/// Reads a --json result. UserError (Input) names the file if it is missing, truncated, not JSON or not written by
/// fastsplat. So it does for a subcommand without a report, and for missing figures.
Result read_result(const std::filesystem::path& file);

/// Subcommands that have reports, sorted.
std::vector<std::string> reported_subcommands();

enum class Status {
  Pass,
  Fail,      ///< a verification or a limit failed
  Error,     ///< undecided: the device hung or a case failed to run
  Measured,  ///< figures without a limit
};
/// "pass", "fail", "error", "none".
const char* to_string(Status status);

struct Verdict {
  Status status = Status::Measured;
  std::string sentence;  ///< the main statement, with its figures; no full stop
};

/// The verdict on one result.
Verdict verdict_of(const Result& result);

/// The overall verdict: the worst status (Error, Fail, Pass, Measured) and the sentence of the first result that has
/// it. `verdicts` must not be empty.
Verdict verdict_of(const std::vector<Verdict>& verdicts);

/// The name of a result in a report.
std::string name_of(const Result& result);

/// The command that reproduces a result; empty if it is not recorded.
std::string command_of(const Result& result);

}  // namespace fastsplat::report
