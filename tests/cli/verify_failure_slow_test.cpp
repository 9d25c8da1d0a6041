// SPDX-License-Identifier: Apache-2.0
// `verify` of a wrong RTL (tests/wrong_rtl), through a program built with it: the failure comes first, whatever happens
// to its files.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "driver/files/stream_file.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

Result verify(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  std::vector<std::string> words{FASTSPLAT_WRONG_RTL, "verify", "--config", "tiny"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_words(words, surroundings);
}

class VerifyFailure : public ::testing::Test {
 protected:
  void SetUp() override { here_.folder = folder_.path(); }
  nlohmann::json json_of() const { return nlohmann::json::parse(read_bytes(folder_ / "result.json")); }

  TempFolder folder_;
  Surroundings here_;
};

TEST_F(VerifyFailure, IsShrunkAndReplayed) {
  const auto run = verify({"--random", "300", "--json", "result.json"}, here_);
  ASSERT_EQ(run.code, 1) << run.err;
  const auto failure = json_of().at("failure");
  EXPECT_EQ(failure.at("splats_after"), 7) << "the seventh is the first that is wrong";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "verify-failure.fss"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "verify-failure.fst"));
  // The printed command line, run unchanged: a legal stream for every reader, which fails in the same way.
  std::istringstream line(failure.at("replay").get<std::string>());
  std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
  ASSERT_GT(words.size(), 2u);
  words[0] = FASTSPLAT_WRONG_RTL;
  const auto again = run_words(words, here_);
  EXPECT_EQ(again.code, 1) << again.err;
  EXPECT_NE(again.out.find("first divergence: stage sheet"), std::string::npos) << again.out;
  EXPECT_NO_THROW(driver::require_covered(folder_ / "verify-failure.fss"));
  expect_success(
      fastsplat({"stream", "replay", folder_ / "verify-failure.fss", "--config", "tiny", "-o", folder_ / "a.exr"}));
}

// The command that follows the pixel shows the word that the model has where the RTL differs.
TEST_F(VerifyFailure, IsFollowedThroughTheModel) {
  const auto run = verify({"--random", "300", "--json", "result.json"}, here_);
  ASSERT_EQ(run.code, 1) << run.err;
  const auto failure = json_of().at("failure");
  const std::string smallest = failure.at("smallest");  // "...: sheet R 0x13, RTL 0x0 (...)"
  std::istringstream line(failure.at("follow").get<std::string>());
  std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
  ASSERT_GT(words.size(), 5u) << smallest;
  std::smatch place;
  ASSERT_TRUE(std::regex_search(smallest, place, std::regex(R"(pixel \((\d+), ?(\d+)\))"))) << smallest;
  EXPECT_EQ(words.at(2), place[1].str() + "," + place[2].str()) << smallest;
  words.erase(words.begin());
  const auto followed = fastsplat(words, here_);
  expect_success(followed);
  const auto end = smallest.find(", RTL"), begin = smallest.rfind(' ', end - 1) + 1;
  const std::string word = smallest.substr(begin, end - begin);
  std::printf("[figure] %s: %s\n", failure.at("follow").get<std::string>().c_str(), word.c_str());
  EXPECT_NE(followed.out.find(" " + word + " "), std::string::npos) << smallest << "\n" << followed.out;
  const std::string stream = read_bytes(folder_ / "verify-failure.fss");
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{64}, stream.size() - 32}) {
    folder_.write("verify-failure.fss", stream.substr(0, bytes));
    expect_error(fastsplat(words, here_), 3, {"verify-failure.fss"});
  }
  folder_.write("verify-failure.fss", stream);
  words.insert(words.end(), {"--volume", "shells:8"});
  expect_error(fastsplat(words, here_), 2, {"--stream"});
}

// The named pixel lies in the tile, and the operands below belong to it.
TEST_F(VerifyFailure, NamesThePixelAndNotTheWindow) {
  for (const std::string stimulus : {"screen-edges", "mixed", "multi-window"}) {
    const auto run = verify({"--random", "300", "--class", stimulus, "--json", "result.json"}, here_);
    ASSERT_EQ(run.code, 1) << run.err;
    const auto failure = json_of().at("failure");
    const std::string smallest = failure.at("smallest"), operands = failure.at("operands");
    const auto at = smallest.find(", pixel ");
    ASSERT_NE(at, std::string::npos) << smallest;
    const std::string pixel = smallest.substr(at + 2, smallest.find(':', at) - at - 2);
    EXPECT_EQ(pixel.find('-'), std::string::npos) << smallest;
    EXPECT_EQ(operands.rfind(pixel + ":", 0), 0u) << smallest << " | " << operands;
    EXPECT_NE(smallest.find("window at ("), std::string::npos) << smallest;
  }
}

TEST_F(VerifyFailure, OfASceneCountsTheWorkDone) {
  const auto run = verify({"--volume", "shells:16", "--size", "48", "--json", "result.json"}, here_);
  ASSERT_EQ(run.code, 1) << run.err;
  std::printf("[figure] splats of the scene before it was stopped = %llu\n",
              static_cast<unsigned long long>(json_of().at("splats").get<std::uint64_t>()));
  EXPECT_GT(json_of().at("splats"), 10);
  EXPECT_GT(json_of().at("windows"), 10);
}

TEST_F(VerifyFailure, IsReportedBeforeItsFiles) {
  // Only short files can be written: neither the stream nor the waveform.
  here_.largest_file = 300;
  const auto run = verify({"--random", "300", "--json", "-"}, here_);
  EXPECT_EQ(run.code, 1) << run.err;
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << run.out << run.err;
  EXPECT_EQ(json.at("verdict"), "mismatch");
  const auto failure = json.at("failure");
  EXPECT_NE(failure.at("first").get<std::string>().find("stage sheet"), std::string::npos);
  EXPECT_FALSE(failure.at("unwritten").empty());
  EXPECT_NE(run.err.find("cannot write"), std::string::npos) << run.err;
  const auto text = verify({"--random", "300"}, here_);
  EXPECT_EQ(text.code, 1) << text.err;
  EXPECT_NE(text.out.find("first divergence: stage sheet"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("replay:"), std::string::npos) << text.out;
}

TEST_F(VerifyFailure, FoldersAreTriedBeforeTheRun) {
  const auto run = verify({"--random", "300", "--failure", "/nonexistent/x"}, here_);
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.out, "") << "it ran";
  EXPECT_NE(run.err.find("/nonexistent/x.fss"), std::string::npos) << run.err;
}

TEST_F(VerifyFailure, KeepsTheFilesOfAnEarlierOne) {
  ASSERT_EQ(verify({"--random", "300", "--seed", "1"}, here_).code, 1);
  const auto first = read_bytes(folder_ / "verify-failure.fss");
  const auto second = verify({"--random", "300", "--seed", "2"}, here_);
  EXPECT_EQ(second.code, 1);
  EXPECT_TRUE(read_bytes(folder_ / "verify-failure.fss") == first);
  EXPECT_NE(second.out.find("verify-failure-2.fss"), std::string::npos) << second.out;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "verify-failure-2.fss"));
  // A given name is used, and files that are replaced are reported.
  EXPECT_EQ(verify({"--random", "300", "--failure", "mine"}, here_).err.find("will be replaced"), std::string::npos);
  const auto again = verify({"--random", "300", "--failure", "mine"}, here_);
  EXPECT_NE(again.err.find("mine.fss of an earlier failure will be replaced"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace fastsplat::cli_test
