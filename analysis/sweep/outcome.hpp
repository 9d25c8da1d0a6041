// SPDX-License-Identifier: Apache-2.0
// The outcome of a run of a case: its JSON, its coverage book, and a message if something went wrong.
//
// Only what the program reports is a result. What the machine does (disk, memory, signals, a crash) is an accident: it
// says nothing about the case, which is run again.
#pragma once

#include "analysis/sweep/child.hpp"
#include "analysis/sweep/result.hpp"

namespace fastsplat::plan {

/// Names of a run's files in its folder.
inline constexpr const char* kJson = "result.json";
inline constexpr const char* kFailure = "failure";  ///< with .fss and .fst

struct Outcome {
  Status status = Status::Pass;
  bool accident = false;  ///< not a result; `status` is Error
  int exit_code = 0;
  std::string message{};                      ///< empty for Pass
  nlohmann::ordered_json json{}, coverage{};  ///< null for none
};

/// Folders of its files; outcomes do not mention them.
struct Places {
  std::filesystem::path folder, shared;
};

/// An outcome is a result, not an accident, if the exit code is one of the results in docs/guide/reference.md and the
/// files are complete.
Outcome outcome_of(const Step& step, const Ended& ended, const Places& places);

void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace fastsplat::plan
