// The input of a report: the JSON results of the subcommands, read and identified.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fastsplat::report {

using Json = nlohmann::ordered_json;

struct Result {
  std::filesystem::path file;  ///< as the user named it
  std::string verb;            ///< "compare", "errors bound"
  Json json;                   ///< the whole object, as the verb wrote it
};

/// What a --json of a verb that can be reported wrote. UserError (Input), in one line that names the file, for what is
/// missing, no JSON, cut off, of another program, of a verb without a report, or without the figures of its verb.
Result read_result(const std::filesystem::path& file);

/// Which verbs that are, sorted.
std::vector<std::string> reported_verbs();

enum class Status {
  Pass,
  Fail,      ///< a verification or a limit failed
  Error,     ///< it could not be decided: the device stood still, a case broke
  Measured,  ///< figures without a limit
};
/// "pass", "fail", "error", "none".
const char* to_string(Status status);

struct Verdict {
  Status status = Status::Measured;
  std::string sentence;  ///< the one that matters, with its figures; no full stop
};

/// Of one result.
Verdict verdict_of(const Result& result);

/// Of all: the worst status (Error, Fail, Pass, Measured), and the sentence of the first result that has it.
/// `verdicts` holds one at least.
Verdict verdict_of(const std::vector<Verdict>& verdicts);

/// The command that makes a result again; empty where the result does not tell.
std::string command_of(const Result& result);

}  // namespace fastsplat::report
