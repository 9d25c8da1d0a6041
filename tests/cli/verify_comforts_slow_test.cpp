// SPDX-License-Identifier: Apache-2.0
// Conveniences for verification through the program: planted faults, waveforms of chosen cycles, a table of all
// mismatches, random streams as files, JUnit XML, jobs.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

class VerifyComforts : public ::testing::Test {
 protected:
  void SetUp() override { here_.folder = folder_.path(); }
  Result verify(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "verify");
    return fastsplat(arguments, here_);
  }
  nlohmann::json json_of(const std::string& name = "result.json") const {
    return nlohmann::json::parse(read_bytes(folder_ / name));
  }
  /// A command line that the program printed, run unchanged.
  Result again(const std::string& line, const std::vector<std::string>& more) const {
    std::istringstream words(line);
    std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    arguments.erase(arguments.begin());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return fastsplat(arguments, here_);
  }

  TempFolder folder_;
  Surroundings here_;
};

TEST_F(VerifyComforts, APlantedFaultIsInEveryFormat) {
  const auto run =
      verify({"--random", "1000", "--fault", "FORWARD_3", "--json", "result.json", "--junit", "result.xml"});
  ASSERT_EQ(run.code, 1) << run.err;
  EXPECT_NE(run.out.find("planted fault FORWARD_3 (in the RTL): sheet bank: no forwarding over two windows"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("\nfirst divergence: stage sheet"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nshrunk from "), std::string::npos) << run.out;
  const auto json = json_of();
  EXPECT_EQ(json.at("planted_fault").at("name"), "FORWARD_3");
  EXPECT_EQ(json.at("verdict"), "mismatch");
  EXPECT_LE(json.at("failure").at("splats_after").get<int>(), 4);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "verify-failure.fst"));
  // The ports of the instance to look at come first, and the marker stands at the divergence.
  const auto view = read_bytes(folder_ / "verify-failure.gtkw");
  const auto instance = json.at("failure").at("instance").get<std::string>();
  EXPECT_LT(view.find("-look at " + instance + "\n@"), view.find("-beats in\n@")) << view;
  EXPECT_TRUE(std::regex_search(view, std::regex("\n\\*-4\\.0 [0-9]+\n"))) << view;
  const auto junit = read_bytes(folder_ / "result.xml");
  EXPECT_NE(junit.find("<failure message=\"planted fault FORWARD_3 ("), std::string::npos) << junit;
  EXPECT_NE(junit.find(" seed 1 mixed\""), std::string::npos) << junit;
  // The replay plants the fault again.
  const auto replayed = again(json.at("failure").at("replay"), {"--json", "again.json"});
  EXPECT_EQ(replayed.code, 1) << replayed.err;
  EXPECT_EQ(json_of("again.json").at("planted_fault").at("name"), "FORWARD_3");
}

TEST_F(VerifyComforts, AnUnseenFaultIsNotAPass) {
  // Memories that a reset does not wipe, empty at power-up, without a second reset.
  const auto run = verify({"--random", "60", "--class", "hazards", "--fill", "zero", "--fault", "MISSED_WIPE", "--json",
                           "result.json", "--junit", "result.xml"});
  ASSERT_EQ(run.code, 1) << run.out << run.err;
  EXPECT_EQ(json_of().at("verdict"), "fault not seen");
  EXPECT_EQ(json_of().at("mismatches"), 0);
  const auto junit = read_bytes(folder_ / "result.xml");
  EXPECT_NE(junit.find("failures=\"1\""), std::string::npos) << junit;
  EXPECT_NE(junit.find("planted fault MISSED_WIPE"), std::string::npos) << junit;
  const auto quiet =
      verify({"--random", "60", "--class", "hazards", "--fill", "zero", "--fault", "MISSED_WIPE", "--quiet"});
  EXPECT_EQ(quiet.code, 1);
  EXPECT_NE(quiet.err.find("fault not seen: MISSED_WIPE; seed 1\n"), std::string::npos) << quiet.err;
}

TEST_F(VerifyComforts, AFaultAtThePortsIsSeenInAScene) {
  // A fault in the middle of its tile: block 1 is never composited.
  for (const char* fault : {"PORT_LOST", "PORT_COMPOSITE"}) {
    const auto run = verify(
        {"--volume", "shells:12", "--size", "24x24", "--config", "tiny", "--fault", fault, "--json", "result.json"});
    EXPECT_EQ(run.code, 1) << fault << run.err;
    EXPECT_EQ(json_of().at("verdict"), "mismatch") << fault;
    EXPECT_GT(json_of().at("mismatches"), 0) << fault;
  }
}

TEST_F(VerifyComforts, FaultsAreListedAndRefused) {
  const auto list = verify({"--fault", "list"});
  expect_success(list);
  for (const char* line :
       {"FORWARD_3 +rtl +sheet bank: no forwarding over two windows\n", "PORT_PIXEL +ports +pixels: "})
    EXPECT_TRUE(std::regex_search(list.out, std::regex(line))) << line << list.out;
  expect_error(verify({"--random", "10", "--fault", "FORWARD_4"}), 2, {"--fault", "FORWARD_4", "did you mean"});
  expect_error(verify({"--random", "10", "--fault", "FORWARD_3", "--config", "tiny"}), 2,
               {"--fault FORWARD_3", "mustfail", "leave out --config"});
  expect_error(verify({"--random", "10", "--fault", "PORT_PIXEL", "--coverage", "a.json"}), 2,
               {"--coverage", "--fault"});
}

/// First and last time of a waveform, from its header: after the block's type and length, big-endian.
std::pair<std::uint64_t, std::uint64_t> times_of(const std::string& bytes) {
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = at; i < at + 8; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(i));
    return value;
  };
  return {number(9), number(17)};
}

TEST_F(VerifyComforts, AWaveformHoldsTheCyclesThatWereAskedFor) {
  for (const std::vector<std::string>& what :
       {std::vector<std::string>{"verify", "--random", "100", "--class", "hazards", "--config", "tiny"},
        {"verify", "--random", "100", "--class", "reset", "--config", "tiny"},
        {"verify", "--volume", "shells:8", "--size", "24", "--config", "tiny"},
        {"render", "--volume", "shells:8", "--size", "24", "--config", "tiny", "--engine", "rtl"}}) {
    auto arguments = what;
    for (const char* word : {"--wave", "run.fst", "--cycles", "100..150", "--json", "result.json"})
      arguments.emplace_back(word);
    const auto run = fastsplat(arguments, here_);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find("waveform: run.fst (cycles 100 to 150)"), std::string::npos) << run.out;
    EXPECT_EQ(json_of().at("wave").at("from"), 100);
    EXPECT_EQ(json_of().at("wave").at("to"), 150);
    ASSERT_GT(std::filesystem::file_size(folder_ / "run.fst"), 500u);
    const auto view = read_bytes(folder_ / "run.gtkw");
    for (const char* line : {"[dumpfile] \"run.fst\"\n", "-beats in\n", "fastsplat_dut.s_tdata_i[255:0]\n",
                             "-u_splat\n", "fastsplat_dut.u_top.u_core.u_splat.clk_i\n"})
      EXPECT_NE(view.find(line), std::string::npos) << line << view;
    // Two times a cycle, at the rising edge of the clock and after the falling one.
    const auto [first, last] = times_of(read_bytes(folder_ / "run.fst"));
    std::printf("[figure] %s: times of the waveform = %llu to %llu (expected 201 to 302)\n", what[0].c_str(),
                static_cast<unsigned long long>(first), static_cast<unsigned long long>(last));
    EXPECT_EQ(first, 201u);
    EXPECT_EQ(last, 302u);
  }
}

TEST_F(VerifyComforts, WaveformsThatCannotBeAreRefused) {
  const std::vector<std::string> one{"--random", "50", "--class", "mixed", "--config", "tiny"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), one.begin(), one.end());
    return verify(more);
  };
  expect_error(with({"--cycles", "1..2"}), 2, {"--cycles", "--wave"});
  expect_error(with({"--wave", "a.vcd"}), 2, {"a.vcd", ".fst", "fst2vcd"});
  for (const char* range : {"5..4", "5", "..", "1..x", "1...4"})
    expect_error(with({"--wave", "a.fst", "--cycles", range}), 2, {"--cycles", "A..B", range});
  expect_error(with({"--wave", "nowhere/a.fst"}), 3, {"nowhere"});
  expect_error(verify({"--random", "50", "--config", "tiny", "--wave", "a.fst"}), 2,
               {"--wave", "18 streams", "--class"});
  expect_error(fastsplat({"render", "--volume", "shells:8", "--wave", "a.fst"}), 2,
               {"--wave", "golden", "--engine rtl"});
  // After the run's end: the result is printed, the waveform does not exist.
  const auto late = with({"--wave", "a.fst", "--cycles", "1000000..1000001", "--json", "result.json"});
  EXPECT_EQ(late.code, 2);
  EXPECT_NE(late.err.find("the run ends before these cycles"), std::string::npos) << late.err;
  EXPECT_EQ(json_of().at("verdict"), "pass");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.fst"));
}

TEST_F(VerifyComforts, AllMismatchesGoOnToTheEnd) {
  const auto run = verify({"--random", "400", "--seeds", "2", "--fault", "PORT_SHEET", "--config", "tiny",
                           "--all-mismatches", "5", "--json", "result.json"});
  ASSERT_EQ(run.code, 1) << run.err;
  const auto json = json_of();
  EXPECT_EQ(json.at("streams"), 36);
  EXPECT_EQ(json.at("all_mismatches").size(), 5u);
  const auto& row = json.at("all_mismatches").at(0);
  EXPECT_EQ(row.at("tap"), "sheet");
  EXPECT_EQ(row.at("splat").get<int>() % 7, 6);
  EXPECT_NE(row.at("expected"), row.at("got"));
  const auto& by_tap = json.at("mismatches_by_tap");
  const std::uint64_t sheet = by_tap.at("sheet");
  std::printf("[figure] mismatches = %llu, of tap sheet = %llu\n",
              static_cast<unsigned long long>(json.at("mismatches").get<std::uint64_t>()),
              static_cast<unsigned long long>(sheet));
  EXPECT_GT(sheet, 20u);
  EXPECT_EQ(sheet, json.at("mismatches").get<std::uint64_t>()) << "nothing else is wrong";
  // Every seventh splat of a tile, and no other: the count equals the rows when all are printed.
  EXPECT_NE(run.out.find("\nby tap: snap 0, footprint 0, sheet "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nseed  class"), std::string::npos) << run.out;
}

TEST_F(VerifyComforts, ASavedStreamReplaysAlike) {
  for (const std::string stimulus : {"mixed", "reset"}) {
    const auto run = verify({"--random", "300", "--class", stimulus, "--seed", "5", "--config", "tiny", "--save-stream",
                             "random.fss", "--coverage", stimulus + "-a.json", "--json", "result.json"});
    ASSERT_EQ(run.code, 0) << run.err;
    const auto first = json_of();
    const auto replay =
        again(first.at("saved").at(0).at("replay"), {"--coverage", stimulus + "-b.json", "--json", "again.json"});
    ASSERT_EQ(replay.code, 0) << replay.err;
    const auto second = json_of("again.json");
    for (const char* same : {"comparisons", "splats", "windows", "cycles_rtl", "cycles_model", "by_tap", "config_hash"})
      EXPECT_EQ(first.at(same), second.at(same)) << same;
    EXPECT_GT(first.at("splats"), 100);
    const auto random = json_of(stimulus + "-a.json").at("campaigns").at(stimulus),
               stream = json_of(stimulus + "-b.json").at("campaigns").at("stream");
    std::printf("[figure] bins of %s = %zu\n", stimulus.c_str(), random.size());
    EXPECT_GT(random.size(), 100u);
    EXPECT_EQ(random, stream);
  }
}

TEST_F(VerifyComforts, StreamsOfSeveralSeedsAreNumbered) {
  const auto run =
      verify({"--random", "40", "--class", "mixed", "--seeds", "3", "--config", "tiny", "--save-stream", "s-##.fss"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"s-00.fss", "s-01.fss", "s-02.fss"}));
  expect_error(verify({"--random", "40", "--config", "tiny", "--save-stream", "s.fss"}), 2,
               {"--save-stream", "18 streams", "####"});
  expect_error(verify({"--random", "40", "--class", "mixed", "--config", "tiny", "--save-stream", "s.bin"}), 2,
               {"s.bin", ".fss"});
  expect_error(verify({"--volume", "shells:8", "--config", "tiny", "--save-stream", "s.fss"}), 2, {"stream record"});
}

TEST_F(VerifyComforts, JobsChangeNoByte) {
  const auto run = [&](const std::string& jobs, const std::string& fault) {
    std::vector<std::string> arguments{"--random",  "200", "--seeds",          "3", "--jobs",   jobs,
                                       "--fault",   fault, "--all-mismatches", "7", "--config", "tiny",
                                       "--failure", "f"};
    const auto result = verify(arguments);
    EXPECT_EQ(result.code, 1) << result.err;
    return result.out;
  };
  const auto one = run("1", "PORT_PIXEL"), two = run("2", "PORT_PIXEL"), many = run("5", "PORT_PIXEL");
  EXPECT_GT(one.size(), 500u);
  EXPECT_EQ(one, two);
  EXPECT_EQ(one, many);
  expect_error(verify({"--random", "10", "--config", "tiny", "--jobs", "2", "--threads", "3"}), 2,
               {"--jobs", "--threads"});
}

TEST_F(VerifyComforts, InterruptedItLeavesNothingHalf) {
  here_.signal = SIGINT;
  here_.when = [](pid_t process) { return handles_signal(process, SIGINT); };
  const auto run = verify({"--random", "100000", "--seeds", "100", "--jobs", "2", "--config", "tiny", "--save-stream",
                           "s-####.fss", "--json", "result.json", "--junit", "result.xml"});
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{});
}

}  // namespace
}  // namespace fastsplat::cli_test
