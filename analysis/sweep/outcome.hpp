// What a run of a case came to: its JSON, its book of coverage, and in words what went wrong.
//
// Only what the program said is a result. What the machine did (disk, memory, signals, a crash) is an accident: it says
// nothing about the case, which is run again.
#pragma once

#include "analysis/sweep/child.hpp"
#include "analysis/sweep/result.hpp"

namespace fastsplat::plan {

/// Names of a run's files in its folder.
inline constexpr const char* kJson = "result.json";
inline constexpr const char* kFailure = "failure";  ///< with .fss and .fst

struct Outcome {
  Status status = Status::Pass;
  bool accident = false;  ///< no result; `status` is Error
  int exit_code = 0;
  std::string message{};                      ///< empty for Pass
  nlohmann::ordered_json json{}, coverage{};  ///< null for none
};

/// Where its files lie: what is said of them forgets that.
struct Places {
  std::filesystem::path folder, shared;
};

/// `ended` is the program's answer where its exit code is one that docs/guide/reference.md gives to answers and its
/// files are whole.
Outcome outcome_of(const Step& step, const Ended& ended, const Places& places);

void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace fastsplat::plan
