// SPDX-License-Identifier: Apache-2.0
// The result of a case: a file FOLDER/ID.json, written atomically, that identifies its case.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/sweep/plan.hpp"

namespace fastsplat::plan {

enum class Status {
  Pass,
  Fail,   ///< exit 1: verified and wrong, or over a limit; the figures are valid
  Error,  ///< the program refused it, or the device it simulates did
};
const char* to_string(Status status);         ///< "pass", "fail", "error"
Status status_from(const std::string& text);  ///< throws std::runtime_error for another word

struct CaseResult {
  std::string id, kind;
  Status status = Status::Pass;
  int exit_code = 0;
  std::string message;  ///< of the run that failed; empty if none did
  std::string program;  ///< hash of the program that made it
  Content content;
  nlohmann::ordered_json results = nlohmann::ordered_json::object();  ///< by subcommand: its JSON, without times
  nlohmann::ordered_json coverage;                                    ///< the book; null if the case has none
};

std::filesystem::path result_path(const std::filesystem::path& folder, const std::string& id);

/// The same bytes for the same result, with a checksum; without times, hosts and folders.
std::string to_text(const CaseResult& result);

/// Throws UserError (Input) that names the file if it is empty, truncated or changed.
CaseResult read_result(const std::filesystem::path& path);

/// Why `result` is not the result of `one` with `program`; empty if it is.
std::string foreign(const CaseResult& result, const Case& one, const std::string& program);

/// Removes from a subcommand's JSON what depends on machine, time and folder: keys "seconds", "..._seconds" and
/// "vectors", and in texts the names of `folders` with the slash after them.
void forget_surroundings(nlohmann::ordered_json& json, const std::vector<std::string>& folders);
std::string forget_surroundings(std::string text, const std::vector<std::string>& folders);

}  // namespace fastsplat::plan
