// SPDX-License-Identifier: Apache-2.0
#include "tests/slurm/small_plan_helper.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace fastsplat::slurm_test {

namespace fs = std::filesystem;
using cli_test::read_bytes;

SmallPlan::SmallPlan(const cli_test::TempFolder& folder, int cases) : folder_(folder.path() / "a b'c\"d%1$x#") {
  fs::create_directories(folder_);
  // From the front this sphere has 65.8 dB, from all other sides more than 71.
  std::ofstream(folder_ / "spec.toml") << "kind = \"compare\"\n"
                                          "[constants]\n"
                                          "volume = \"shells:32\"\n"
                                          "size = 48\n"
                                          "min-psnr = 68\n"
                                          "[axes]\n"
                                          "azimuth = {from = 0, to = "
                                       << 10 * (cases - 1) << ", step = 10}\n";
  succeed({"plan", "make", "spec.toml", "-o", "plan.json"});
  const auto plan = nlohmann::json::parse(read_bytes(folder_ / "plan.json"));
  for (const auto& one : plan.at("cases")) ids_.push_back(one.at("id"));
}

cli_test::Result SmallPlan::run(const std::vector<std::string>& words,
                                const std::vector<std::string>& environment) const {
  cli_test::Surroundings here;
  here.folder = folder_;
  here.environment = environment;
  return cli_test::fastsplat(words, here);
}

cli_test::Result SmallPlan::succeed(const std::vector<std::string>& words,
                                    const std::vector<std::string>& environment) const {
  auto result = run(words, environment);
  EXPECT_EQ(result.code, 0) << result.err;
  return result;
}

std::string SmallPlan::run_here(const std::string& results) const {
  EXPECT_EQ(run({"plan", "run", "plan.json", "--results", results, "--jobs", "2", "--quiet"}).code, 1);  // one fails
  succeed({"plan", "merge", "plan.json", "--results", results, "-o", results + ".merged.json"});
  return read_bytes(folder_ / (results + ".merged.json"));
}

std::vector<fs::path> SmallPlan::files_of(const std::string& results, int shard, int shards) const {
  std::vector<fs::path> files;
  for (std::size_t at = 0; at < ids_.size(); ++at) {
    if (static_cast<int>(at) % shards == shard - 1) files.push_back(folder_ / results / (ids_[at] + ".json"));
  }
  return files;
}

std::vector<fs::path> SmallPlan::done_of(const std::string& results, int shard, int shards) const {
  auto files = files_of(results, shard, shards);
  std::erase_if(files, [](const fs::path& file) { return !fs::exists(file); });
  return files;
}

void SmallPlan::copy_without(const std::string& from, const std::string& to, int shard, int shards) const {
  fs::create_directories(folder_ / to);
  for (int other = 1; other <= shards; ++other) {
    if (other == shard) continue;
    for (const auto& file : files_of(from, other, shards)) fs::copy(file, folder_ / to / file.filename());
  }
}

int rows_with(const std::string& merged, const std::string& status) {
  int rows = 0;
  const auto json = nlohmann::json::parse(merged);
  for (const auto& row : json.at("rows")) rows += row.at("status") == status ? 1 : 0;
  return rows;
}

void figure(const char* name, double value, const std::string& limit) {
  std::printf("[figure] %s = %g (limit %s)\n", name, value, limit.c_str());
  ::testing::Test::RecordProperty(name, std::to_string(value));
}

}  // namespace fastsplat::slurm_test
