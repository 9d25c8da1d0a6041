// SPDX-License-Identifier: Apache-2.0
// verify --coverage: sampled, added up over runs, refused for another configuration.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

nlohmann::json book(const std::filesystem::path& path) { return nlohmann::json::parse(read_bytes(path)); }

std::uint64_t hits(const nlohmann::json& book, const char* campaign, const char* bin) {
  return book.at("campaigns").at(campaign).at(bin);
}

TEST(VerifyCoverage, AddsUpOverRuns) {
  const TempFolder folder;
  const std::string file = folder / "c.json";
  const auto random = [&](const char* config) {
    return fastsplat({"verify", "--random", "50", "--class", "hazards", "--config", config, "--coverage", file});
  };
  const auto first = random("tiny");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.out.find("coverage: "), std::string::npos) << first.out;
  const auto once = book(file);
  EXPECT_EQ(hits(once, "hazards", "record.splat"), 50u);
  EXPECT_EQ(once.at("config"), "tiny");
  ASSERT_EQ(random("tiny").code, 0);
  const auto twice = book(file);
  EXPECT_EQ(hits(twice, "hazards", "record.splat"), 100u);
  EXPECT_EQ(twice.at("streams"), 2);
  const auto scene =
      fastsplat({"verify", "--volume", "shells:8", "--size", "16", "--config", "tiny", "--coverage", file});
  ASSERT_EQ(scene.code, 0) << scene.err;
  EXPECT_GT(hits(book(file), "scene", "record.splat"), 0u);
  const auto other = random("small");
  EXPECT_EQ(other.code, 4);
  EXPECT_NE(other.err.find("holds coverage of another configuration"), std::string::npos) << other.err;
  folder.write("d.json", "{}");
  const auto foreign = fastsplat({"verify", "--random", "50", "--config", "tiny", "--coverage", folder / "d.json"});
  EXPECT_EQ(foreign.code, 3);
  EXPECT_NE(foreign.err.find("not a coverage file"), std::string::npos) << foreign.err;
}

TEST(VerifyCoverage, TwoFilesAreCompared) {
  const TempFolder folder;
  const auto run = [&](const char* which, const char* config, const std::string& file) {
    return fastsplat({"verify", "--random", "50", "--class", which, "--config", config, "--coverage", folder / file});
  };
  ASSERT_EQ(run("hazards", "tiny", "old.json").code, 0);
  ASSERT_EQ(run("saturation", "tiny", "new.json").code, 0);
  const auto both = fastsplat({"compare", folder / "old.json", folder / "new.json", "--json", folder / "d.json"});
  EXPECT_EQ(both.code, 1) << both.err;
  // Counted here from the files.
  const auto of = [&](const char* file, const char* campaign) {
    return book(folder / file).at("campaigns").at(campaign).get<std::map<std::string, std::uint64_t>>();
  };
  const auto old_bins = of("old.json", "hazards"), new_bins = of("new.json", "saturation");
  std::map<std::string, std::uint64_t> lost, gained;
  for (const auto& [name, hits] : old_bins) {
    if (hits > 0 && new_bins.at(name) == 0) lost[name] = hits;
  }
  for (const auto& [name, hits] : new_bins) {
    if (hits > 0 && old_bins.at(name) == 0) gained[name] = hits;
  }
  std::printf("[figure] bins lost = %zu, gained = %zu (limit > 0)\n", lost.size(), gained.size());
  EXPECT_GT(lost.size(), 0u);
  EXPECT_GT(gained.size(), 0u);
  const auto json = book(folder / "d.json");
  EXPECT_EQ(json.at("lost"), nlohmann::json(lost));
  EXPECT_EQ(json.at("gained"), nlohmann::json(gained));
  EXPECT_NE(both.out.find("lost: " + std::to_string(lost.size()) + "\n"), std::string::npos) << both.out;
  // Nothing is lost against a part of itself.
  ASSERT_EQ(run("hazards", "tiny", "new.json").code, 0);
  EXPECT_EQ(fastsplat({"compare", folder / "old.json", folder / "new.json"}).code, 0);
  ASSERT_EQ(run("hazards", "small", "small.json").code, 0);
  expect_error(fastsplat({"compare", folder / "old.json", folder / "small.json"}), 4,
               {"small.json", "holds coverage of another configuration", "tiny", "small"});
  for (const auto& [flag, value] : std::map<std::string, std::string>{
           {"--min-psnr", "40"}, {"--max-lsb", "1"}, {"--map", folder / "m.png"}, {"--peak", "2"}})
    expect_error(fastsplat({"compare", folder / "old.json", folder / "new.json", flag, value}), 2,
                 {flag, "means nothing for coverage files"});
}

// File, expected and found content, in that order, and the fix.
TEST(VerifyCoverage, AnotherConfigurationsFileIsNamed) {
  const TempFolder folder;
  const std::string file = folder / "c.json";
  const std::vector<std::string> run{"verify",   "--random", "50",         "--class", "hazards",
                                     "--config", "tiny",     "--coverage", file};
  ASSERT_EQ(fastsplat(run).code, 0);
  auto other = book(file);
  const std::string ours = other.at("config_hash");
  other["config"] = "other";
  other["config_hash"] = "00000000000000ff";
  folder.write("c.json", other.dump());
  expect_error(fastsplat(run), 4,
               {file + ": holds coverage of another configuration",
                "expected tiny " + ours + ", got other 00000000000000ff", "name a file of that configuration"});
}

// Processes that add to one file at the same time: the sum is complete.
TEST(VerifyCoverage, NothingIsLostBetweenProcesses) {
  constexpr int kProcesses = 8;
  const TempFolder folder;
  const std::string file = folder / "c.json";
  std::vector<std::thread> threads;
  std::vector<int> codes(kProcesses, -1);
  for (int i = 0; i < kProcesses; ++i) {
    threads.emplace_back([&, i] {
      codes[static_cast<std::size_t>(i)] =
          fastsplat({"verify", "--random", "400", "--class", "mixed", "--config", "tiny", "--coverage", file,
                     "--failure", folder / std::to_string(i)})
              .code;
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(codes, std::vector<int>(kProcesses, 0));
  const auto sum = book(file);
  std::printf("[figure] splats of %d runs = %llu\n", kProcesses,
              static_cast<unsigned long long>(sum.at("splats").get<std::uint64_t>()));
  EXPECT_EQ(sum.at("splats"), 400 * kProcesses);
  EXPECT_EQ(sum.at("streams"), kProcesses);
  EXPECT_EQ(hits(sum, "mixed", "record.splat"), 400u * kProcesses);
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"c.json"});
}

}  // namespace
}  // namespace fastsplat::cli_test
