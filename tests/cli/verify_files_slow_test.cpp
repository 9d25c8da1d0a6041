// SPDX-License-Identifier: Apache-2.0
// The files of a failing verify: several runs at once keep theirs apart, an interrupted run leaves none, and the
// verdict does not depend on them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Words = std::vector<std::string>;

class VerifyFiles : public ::testing::Test {
 protected:
  void SetUp() override { here_.folder = folder_.path(); }
  nlohmann::json json_of(const std::string& name) const { return nlohmann::json::parse(read_bytes(folder_ / name)); }

  TempFolder folder_;
  Surroundings here_;
};

Words failing(const std::string& seed, const Words& more) {
  Words words{"verify", "--random", "500",       "--class", "mixed", "--config",
              "tiny",   "--fault",  "PORT_SNAP", "--seed",  seed};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(VerifyFiles, OfRunsThatFailAtOnceAreEachItsOwn) {
  const Words seeds{"1", "2", "3", "4", "5", "6"};
  std::vector<std::thread> runs;
  for (const auto& seed : seeds)
    runs.emplace_back([&, seed] { fastsplat(failing(seed, {"--json", "result-" + seed + ".json"}), here_); });
  for (auto& run : runs) run.join();
  std::set<std::string> streams;
  std::size_t alike = 0;
  for (const auto& seed : seeds) {
    const auto failure = json_of("result-" + seed + ".json").at("failure");
    streams.insert(failure.at("stream"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / failure.at("waveform").get<std::string>()));
    // The printed command line fails as the run that printed it.
    std::istringstream line(failure.at("replay").get<std::string>());
    Words words{std::istream_iterator<std::string>(line), {}};
    words.erase(words.begin());
    words.insert(words.end(), {"--json", "again.json", "--failure", "again"});
    EXPECT_EQ(fastsplat(words, here_).code, 1);
    alike += json_of("again.json").at("failure").at("first") == failure.at("smallest") ? 1 : 0;
  }
  std::printf("[figure] streams = %zu, replay lines that are true = %zu (expected %zu)\n", streams.size(), alike,
              seeds.size());
  EXPECT_EQ(streams.size(), seeds.size());
  EXPECT_EQ(alike, seeds.size());
  EXPECT_TRUE(streams.contains("verify-failure.fss"));
  EXPECT_TRUE(streams.contains("verify-failure-6.fss")) << "no number is left out";
  for (const auto& name : folder_.entries()) EXPECT_FALSE(name.starts_with(".")) << name;
}

TEST_F(VerifyFiles, DoNotTakeANameOfTheSameCommand) {
  const auto run = fastsplat(failing("1", {"--wave", "verify-failure.fst", "--json", "result.json"}), here_);
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_EQ(json_of("result.json").at("failure").at("waveform"), "verify-failure-2.fst");
  EXPECT_EQ(json_of("result.json").at("wave").at("file"), "verify-failure.fst");
}

// /proc accepts no files.
TEST_F(VerifyFiles, AreNotNeededToPass) {
  here_.folder = "/proc";
  const auto run = fastsplat({"verify", "--random", "100", "--config", "tiny"}, here_);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("pass: "), std::string::npos) << run.out;
}

TEST_F(VerifyFiles, ThatCannotBeLeaveTheVerdict) {
  here_.folder = "/proc";
  const auto run = fastsplat(failing("1", {"--json", "-"}), here_);
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_NE(run.err.find("warning: verify-failure.fss: cannot write"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--failure PREFIX"), std::string::npos) << run.err;
  const auto failure = nlohmann::json::parse(run.out).at("failure");
  EXPECT_EQ(failure.at("stream"), "");
  EXPECT_EQ(failure.at("waveform"), "");
  EXPECT_EQ(failure.at("unwritten").size(), 1u);
  EXPECT_NE(failure.at("smallest"), "") << "it is made small all the same";
  // A given path is tried before the run.
  expect_error(fastsplat(failing("1", {"--failure", "mine"}), here_), 3, {"mine.fss"});
}

TEST_F(VerifyFiles, OneThatCannotBeLeavesTheOthersAndTheVerdict) {
  const auto run =
      fastsplat(failing("1", {"--junit", "/dev/full", "--json", "result.json", "--save-stream", "run.fss"}), here_);
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_NE(run.err.find("warning: /dev/full: cannot write"), std::string::npos) << run.err;
  EXPECT_EQ(json_of("result.json").at("verdict"), "mismatch");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run.fss"));

  here_.largest_file = 6000;  // the JSON has two thousand, the stream eight
  const auto small =
      fastsplat(failing("1", {"--junit", "small.xml", "--json", "small.json", "--save-stream", "small.fss"}), here_);
  EXPECT_EQ(small.code, 1) << small.err;
  EXPECT_NE(small.err.find("warning: small.fss: cannot write"), std::string::npos) << small.err;
  EXPECT_NE(read_bytes(folder_ / "small.xml").find("failures=\"1\""), std::string::npos);
  EXPECT_FALSE(json_of("small.json").contains("saved"));
  EXPECT_NE(json_of("small.json").at("unwritten").at(0).get<std::string>().find("small.fss"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "small.fss"));
}

// After a pass it is an error, and the message counts the files of a numbered set that exist.
TEST_F(VerifyFiles, OneThatCannotBeLeavesTheOthersOfAPass) {
  Words words{"verify", "--random", "4000", "--config", "tiny", "--save-stream", "run-##.fss", "--json"};
  auto first = words;
  first.push_back("first.json");
  ASSERT_EQ(fastsplat(first, here_).code, 0);
  std::uintmax_t largest = 0;
  const auto before = json_of("first.json");
  for (const auto& saved : before.at("saved")) {
    const auto file = folder_.path() / saved.at("stream").get<std::string>();
    largest = std::max(largest, std::filesystem::file_size(file));
    std::filesystem::remove(file);
  }
  here_.largest_file = largest - 1;
  words.insert(words.end(), {"result.json", "--junit", "result.xml", "--coverage", "covered.json"});
  const auto run = fastsplat(words, here_);
  EXPECT_EQ(run.code, 3) << run.err;
  const auto result = json_of("result.json");
  const auto saved = result.value("saved", nlohmann::json::array()).size();
  const auto streams = result.at("streams").get<std::size_t>();
  EXPECT_GT(saved, 0u);
  EXPECT_LT(saved, streams);
  EXPECT_NE(run.out.find("saved: " + std::to_string(saved) + " of " + std::to_string(streams) + " streams"),
            std::string::npos)
      << run.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "covered.json"));
  std::printf("[figure] streams saved of a set of which one is too large = %zu of %zu\n", saved, streams);
  EXPECT_EQ(result.at("verdict"), "pass");
  EXPECT_EQ(result.at("unwritten").size(), 2u) << "coverage and a stream";
  for (const auto& why : result.at("unwritten"))
    EXPECT_NE(run.err.find("error: " + why.get<std::string>()), std::string::npos) << run.err;
  EXPECT_NE(read_bytes(folder_ / "result.xml").find("failures=\"0\""), std::string::npos);
}

TEST_F(VerifyFiles, AreNamedOnStderrByAQuietRun) {
  const auto run = fastsplat(failing("1", {"--quiet"}), here_);
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const char* word : {"fastsplat: error: planted fault PORT_SNAP: mismatch: stage snap",
                           "waveform: verify-failure.fst", "replay: fastsplat verify --stream verify-failure.fss"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << run.err;
}

TEST_F(VerifyFiles, MismatchesThatAreNotCountedToTheEndSaySo) {
  const auto verify = [&](const Words& more) {
    Words words = {"verify", "--random", "20000", "--class", "mixed", "--config", "tiny", "--fault", "PORT_SHEET"};
    words.insert(words.end(), more.begin(), more.end());
    return fastsplat(words, here_);
  };
  const auto stopped = verify({"--json", "stopped.json"}),
             all = verify({"--json", "all.json", "--all-mismatches", "1"});
  // The run stops with a cycle, which may have several mismatches.
  EXPECT_NE(stopped.out.find(" mismatches, stopped there"), std::string::npos) << stopped.out;
  EXPECT_GE(json_of("stopped.json").at("mismatches"), 1000);
  EXPECT_LT(json_of("stopped.json").at("mismatches"), 1010);
  EXPECT_EQ(json_of("stopped.json").at("stopped"), true);
  const std::uint64_t number = json_of("all.json").at("mismatches");
  std::printf("[figure] mismatches to the end = %llu (limit > 1000)\n", static_cast<unsigned long long>(number));
  EXPECT_GT(number, 1000u);
  EXPECT_EQ(json_of("all.json").at("stopped"), false);
  EXPECT_EQ(all.out.find("stopped there"), std::string::npos) << all.out;
}

/// True once the simulator writes a waveform in the folder.
bool waveform_begun(const TempFolder& folder) {
  const auto names = folder.entries();
  return std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.ends_with(".hier"); });
}

// The signal goes to the program alone, as from `kill`. Its waveform writer must end with it, because the reader of its
// stdout waits for that.
TEST_F(VerifyFiles, OfAnInterruptedWaveformAreGone) {
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    here_.signal = signal;
    auto begin = std::chrono::steady_clock::now();
    here_.when = [&](pid_t) {
      begin = std::chrono::steady_clock::now();
      return waveform_begun(folder_);
    };
    const auto run =
        fastsplat({"verify", "--random", "20000", "--class", "mixed", "--config", "tiny", "--wave", "run.fst"}, here_);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("[figure] signal %d: the last writer of stdout was gone after %.1f s (limit 5)\n", signal, seconds);
    EXPECT_LT(seconds, 5.0) << "the waveform was written to its end";
    EXPECT_FALSE(run.timed_out);
    EXPECT_EQ(run.out.find("waveform:"), std::string::npos) << "the signal came too late";
    if (signal == SIGKILL) continue;  // no process is left to remove anything
    EXPECT_EQ(run.code, 128 + signal) << run.err;
    ::usleep(100'000);
    EXPECT_EQ(folder_.entries(), Words{});
  }
}

// A stream is held in memory: if it does not fit, the message says how to make it smaller.
TEST_F(VerifyFiles, AStreamThatMemoryDoesNotTakeIsRefused) {
  const auto run = run_words(
      {"sh", "-c", "ulimit -v 700000; exec \"$0\" verify --random 10000000 --class mixed --config tiny", program()},
      here_);
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_NE(run.err.find("--random 10000000: not enough memory"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("lower --random and raise --seeds"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace fastsplat::cli_test
