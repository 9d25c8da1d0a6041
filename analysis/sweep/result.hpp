// The result of a case: a file FOLDER/ID.json that is there whole or not at all and tells what it is of.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/sweep/plan.hpp"

namespace fastsplat::plan {

enum class Status {
  Pass,
  Fail,   ///< exit 1: verified and wrong, or over a limit; the figures stand
  Error,  ///< the program refused it, or the device it simulates did
};
const char* to_string(Status status);         ///< "pass", "fail", "error"
Status status_from(const std::string& text);  ///< throws std::runtime_error for another word

struct CaseResult {
  std::string id, kind;
  Status status = Status::Pass;
  int exit_code = 0;
  std::string message;  ///< of the run that failed; empty where none did
  std::string program;  ///< hash of the program that made it
  Content content;
  nlohmann::ordered_json results = nlohmann::ordered_json::object();  ///< by verb: what it wrote, without times
  nlohmann::ordered_json coverage;                                    ///< the book; null where the case has none
};

std::filesystem::path result_path(const std::filesystem::path& folder, const std::string& id);

/// The same bytes for the same result, with a checksum. No time, no host, no folder is in it.
std::string to_text(const CaseResult& result);

/// Throws UserError (Input) that names the file if it is empty, truncated or changed.
CaseResult read_result(const std::filesystem::path& path);

/// Why `result` is not what `one` would give now with `program`; empty where it is.
std::string foreign(const CaseResult& result, const Case& one, const std::string& program);

/// What depends on the machine, the hour and the folder taken out of a verb's JSON: keys "seconds" and "..._seconds",
/// "vectors"; `folder` and the slash after it at the beginning of texts.
void forget_surroundings(nlohmann::ordered_json& json, const std::vector<std::string>& folders);
std::string forget_surroundings(std::string text, const std::vector<std::string>& folders);

}  // namespace fastsplat::plan
