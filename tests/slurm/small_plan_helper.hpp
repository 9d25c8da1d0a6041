// SPDX-License-Identifier: Apache-2.0
// A plan of short cases, the first of which fails: made and run by the program, here and elsewhere.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/process/process_helper.hpp"

namespace fastsplat::slurm_test {

/// In a folder whose name needs every kind of quoting.
class SmallPlan {
 public:
  /// `cases`: at most eight.
  SmallPlan(const cli_test::TempFolder& folder, int cases);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  /// The program in that folder.
  cli_test::Result run(const std::vector<std::string>& words, const std::vector<std::string>& environment = {}) const;
  /// The same; it must succeed.
  cli_test::Result succeed(const std::vector<std::string>& words,
                           const std::vector<std::string>& environment = {}) const;

  /// Runs every case here, two at a time, and returns the merged bytes.
  std::string run_here(const std::string& results) const;
  /// Result files of the cases of a shard.
  std::vector<std::filesystem::path> files_of(const std::string& results, int shard, int shards) const;
  /// The existing ones among them.
  std::vector<std::filesystem::path> done_of(const std::string& results, int shard, int shards) const;
  /// Copies a folder of results without the files of a shard.
  void copy_without(const std::string& from, const std::string& to, int shard, int shards) const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> ids_;
};

/// How many rows of merged bytes have this status.
int rows_with(const std::string& merged, const std::string& status);

void figure(const char* name, double value, const std::string& limit);

}  // namespace fastsplat::slurm_test
