// SPDX-License-Identifier: Apache-2.0
// Small plans of a program that is a shell script, in a folder of their own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/sweep/make.hpp"
#include "analysis/sweep/run.hpp"

namespace fastsplat::plan_test {

/// A fresh folder under the system's temporary folder, removed with all it holds.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

std::string read(const std::filesystem::path& path);
/// Names and bytes of the results in a folder: ID.json.
std::vector<std::pair<std::string, std::string>> results_in(const std::filesystem::path& folder);

/// Subcommands "cycles" and "verify" with --n, --bad and, for the configuration, --config and --set; "render" and
/// "compare" like those of the kind compare. A configuration's hash is its words.
plan::Vocabulary vocabulary();

/// A script as such a program: its JSON holds "n" and the time. --n 13 breaks a limit, --n 99 is refused, --n 66 is
/// ended by a signal. Until FOLDER/mended exists, the machine fails for --n 70 to 75, 126 and 139: exit codes, or no
/// JSON or half of it (71 to 73). It writes its arguments to FOLDER/log. `before`: shell lines run first.
std::string script(const Folder& folder, const std::string& before = {});

/// Runs that script.
plan::Program executed(const std::string& script);

/// Of a specification's text.
plan::Plan plan_of(const Folder& folder, const std::string& spec);

plan::RunSummary run(const Folder& folder, const plan::Plan& plan, const std::string& program,
                     const std::string& results = "results", plan::Shard shard = {}, std::size_t jobs = 1);

/// The message of the error that `call` throws; empty if it throws none.
template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace fastsplat::plan_test
