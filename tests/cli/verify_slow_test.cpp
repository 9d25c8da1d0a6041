// SPDX-License-Identifier: Apache-2.0
// A verified run for scripts: both clocks, and that they agree.
#include <gtest/gtest.h>

#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/replay_line.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "testbench/check/verify.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

std::uint64_t agreed_cycles(const nlohmann::json& json) {
  const std::uint64_t rtl = json.at("cycles_rtl"), model = json.at("cycles_model");
  std::printf("[figure] %s: cycles of the RTL = %llu, of the cycle model = %llu\n",
              json.at("verb").get<std::string>().c_str(), static_cast<unsigned long long>(rtl),
              static_cast<unsigned long long>(model));
  EXPECT_EQ(rtl, model);
  return rtl;
}

TEST(Verify, PrintsTheCyclesOfRtlAndModel) {
  for (const std::vector<std::string>& what :
       {std::vector<std::string>{"--random", "100"}, {"--volume", "shells:8", "--size", "24"}}) {
    std::vector<std::string> arguments{"verify", "--config", "tiny", "--json", "-"};
    arguments.insert(arguments.end(), what.begin(), what.end());
    const auto run = fastsplat(arguments);
    ASSERT_EQ(run.code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("verdict"), "pass");
    EXPECT_EQ(json.at("mismatches"), 0);
    EXPECT_GT(json.at("comparisons"), 100);
    EXPECT_GT(json.at("splats"), 50);
    EXPECT_EQ(json.at("seed"), 1);
    EXPECT_EQ(json.at("config_hash").get<std::string>().size(), 16u);
    EXPECT_GT(agreed_cycles(json), 500u);
  }
}

TEST(Verify, ReportsEverySeedOfACampaign) {
  const auto run =
      fastsplat({"verify", "--config", "tiny", "--random", "200", "--seed", "7", "--seeds", "3", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  const auto rows = json.at("by_seed");
  ASSERT_EQ(rows.size(), 3u);
  for (const std::string what : {"streams", "splats", "comparisons", "cycles"}) {
    std::uint64_t sum = 0;
    for (const auto& row : rows) sum += row.at(what).get<std::uint64_t>();
    EXPECT_EQ(sum, json.at(what == "cycles" ? "cycles_rtl" : what)) << what;
    std::printf("[figure] %s of the seeds = %llu\n", what.c_str(), static_cast<unsigned long long>(sum));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("seed"), 7 + i);
    EXPECT_EQ(rows[i].at("verdict"), "pass");
    EXPECT_GT(rows[i].at("comparisons"), 0);
  }
  EXPECT_EQ(json.at("by_seed_left_out"), 0);
}

// RTL is found by the numbers of a configuration, not by its name.
TEST(Verify, AFileThatEqualsAConfigurationWithRtlRunsOnIt) {
  const TempFolder folder;
  auto config = driver::load_config("tiny");
  config.name = "mine";
  const auto file = folder.write("mine.toml", driver::to_toml(config));
  const auto run = fastsplat({"verify", "--random", "50", "--config", file, "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("verdict"), "pass");
  EXPECT_EQ(json.at("config"), "mine");
  EXPECT_GT(json.at("comparisons"), 100);
}

TEST(Verify, RenderWithCheckReportsThemToo) {
  const auto render = [](bool check) {
    std::vector<std::string> arguments{"render", "--volume", "shells:8", "--size", "24", "--engine",
                                       "rtl",    "--config", "tiny",     "--json", "-"};
    if (check) arguments.push_back("--check");
    const auto run = fastsplat(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(run.out);
  };
  const auto checked = render(true), plain = render(false);
  EXPECT_EQ(agreed_cycles(checked), plain.at("cycles_rtl").get<std::uint64_t>());
  EXPECT_FALSE(plain.contains("cycles_model"));
  EXPECT_EQ(checked.at("counters"), plain.at("counters"));
}

TEST(Verify, AReplayLineIsTakenAsItIs) {
  // The command line that a failure prints: it verifies the stream that it names, with the same settings.
  const TempFolder folder;
  const std::string stream = folder / "a.fss";
  expect_success(
      fastsplat({"stream", "record", "--volume", "shells:8", "--size", "24", "--config", "tiny", "-o", stream}));
  const auto config = driver::load_config("tiny");
  const testbench::VerifyOptions options{.config = config,
                                         .ready = "random-40",
                                         .input = "burst-5",
                                         .fill = testbench::ResetFill::One,
                                         .seed = 77,
                                         .reset_after = 40,
                                         .wave = {},
                                         .coverage = false,
                                         .device = {}};
  std::istringstream line(cli::replay_line(stream, {.config = "tiny", .changes = {}}, options));
  std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
  ASSERT_EQ(words.front(), "fastsplat");
  words.erase(words.begin());
  words.insert(words.end(), {"--json", "-"});
  const auto run = fastsplat(words);
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("ready"), "random-40");
  EXPECT_EQ(json.at("input"), "burst-5");
  EXPECT_EQ(json.at("fill"), "one");
  EXPECT_EQ(json.at("seed"), 77);
  testbench::BeatSource source = [&](const testbench::BeatSink& sink) { driver::read_beats(stream, sink); };
  const auto here = testbench::verify(source, options);
  EXPECT_EQ(json.at("comparisons"), here.check.comparisons);
  EXPECT_EQ(agreed_cycles(json), here.check.cycles_rtl.value_or(0));
}

TEST(Verify, ScenesFlagsBesideAStreamAreRefused) {
  expect_error(fastsplat({"verify", "--random", "10", "--config", "tiny", "--size", "64"}), 2,
               {"--random", "a scene's flags", "--volume"});
}

TEST(Verify, ASceneWithoutSplatsOnTheDeviceIsNotAPass) {
  // tiny's colour words are too short for the automatic exposure of an X-ray: every voxel rounds to nothing.
  const auto verify = [](const std::string& exposure) {
    return fastsplat({"verify", "--volume", "shells:64", "--size", "24", "--method", "xray", "--xray-exposure",
                      exposure, "--config", "tiny", "--json", "-"});
  };
  const auto dark = verify("1e-9"), bright = verify("0.1");
  EXPECT_EQ(dark.code, 1);
  EXPECT_NE(dark.err.find("no splat of the scene reached the device"), std::string::npos) << dark.err;
  const auto json = nlohmann::json::parse(dark.out);
  EXPECT_EQ(json.at("verdict"), "nothing compared");
  EXPECT_EQ(json.at("splats"), 0);
  EXPECT_EQ(bright.code, 0) << bright.err;
  EXPECT_GT(nlohmann::json::parse(bright.out).at("splats"), 100);
}

}  // namespace
}  // namespace fastsplat::cli_test
