// SPDX-License-Identifier: Apache-2.0
// `fastsplat cycles`: the rows add up, a stream costs the same as its scene, the timeline can be drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/cli/words_helper.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using nlohmann::json;

std::uint64_t sum_of(const json& account) {
  std::uint64_t sum = 0;
  for (const auto& [name, cycles] : account.items()) sum += cycles.get<std::uint64_t>();
  return sum;
}

TEST(Cycles, AddUpAndAreTheSameForSceneAndStream) {
  const TempFolder folder;
  const std::vector<std::string> scene{"--volume", "shells:24", "--size", "110x90", "--config", "small"};
  const std::vector<std::string> channel{"--input", "random-70", "--ready", "burst-9", "--json", "-"};
  auto words = scene;
  words.insert(words.begin(), {"stream", "record"});
  words.insert(words.end(), {"-o", folder / "s.fss", "--json", "-"});
  const auto recorded = fastsplat(words);
  expect_success(recorded);

  words = scene;
  words.insert(words.begin(), "cycles");
  words.insert(words.end(), channel.begin(), channel.end());
  const auto from_scene = fastsplat(words);
  words = {"cycles", "--config", "small", "--stream", folder / "s.fss"};
  words.insert(words.end(), channel.begin(), channel.end());
  const auto from_stream = fastsplat(words);
  expect_success(from_scene);
  expect_success(from_stream);

  // Figures that only the JSON has.
  EXPECT_NE(json::parse(from_scene.out)["scene"].get<std::string>().find(" pixels"), std::string::npos)
      << from_scene.out;
  EXPECT_EQ(json::parse(from_stream.out)["stream"], folder / "s.fss");
  EXPECT_NE(json::parse(from_scene.out)["scene"].get<std::string>().find(" 110x90 "), std::string::npos);
  EXPECT_EQ(json::parse(from_stream.out)["width"], 110);
  EXPECT_EQ(json::parse(from_stream.out)["height"], 90);
  EXPECT_EQ(json::parse(recorded.out)["scene"], json::parse(from_scene.out)["scene"]);
  const auto a = json::parse(from_scene.out)["cycles"], b = json::parse(from_stream.out)["cycles"];
  EXPECT_GT(a["actual"].get<std::uint64_t>(), 0U);
  EXPECT_EQ(sum_of(a["account"]), a["actual"].get<std::uint64_t>());
  EXPECT_EQ(sum_of(b["account"]), b["actual"].get<std::uint64_t>());
  // The stream has one more record, end_frame, which comes while the last picture is output (M-account-3).
  EXPECT_EQ(a["account"], b["account"]);
  // The same for the bytes, and energy only where there are pixels.
  const auto traffic = [](const std::string& text) { return json::parse(text)["traffic"]; };
  EXPECT_EQ(sum_of(traffic(from_scene.out)["in"]), traffic(from_scene.out)["bytes_in"].get<std::uint64_t>());
  EXPECT_EQ(traffic(from_scene.out)["bytes_in"].get<std::uint64_t>() + 32,
            traffic(from_stream.out)["bytes_in"].get<std::uint64_t>());
  EXPECT_EQ(traffic(from_scene.out)["bytes_out"], 112 * 90 * 16);  // beats of four pixels
  EXPECT_GT(traffic(from_scene.out)["records_each"].get<double>(), 1.0);
  EXPECT_TRUE(json::parse(from_stream.out)["energy"].is_null());
  const auto energy = json::parse(from_scene.out)["energy"];
  EXPECT_GT(energy["low_uj"].get<double>(), 0.0);
  EXPECT_LT(energy["low_uj"].get<double>(), energy["high_uj"].get<double>());
  std::printf("[figure] busy cycles = %llu, sum of the causes %llu\n",
              static_cast<unsigned long long>(a["actual"].get<std::uint64_t>()),
              static_cast<unsigned long long>(sum_of(a["account"])));
}

/// The text's last lines, and the frames that have no energy.
TEST(Cycles, SayBytesAndEnergy) {
  const auto lines_of = [](const std::vector<std::string>& words) {
    const auto run = fastsplat(words);
    expect_success(run);
    std::vector<std::string> out;
    std::istringstream text(run.out);
    for (std::string line; std::getline(text, line);)
      if (line.starts_with("stream: ") || line.starts_with("energy: ")) out.push_back(line);
    EXPECT_EQ(out.size(), 2U) << run.out;
    return out;
  };
  const auto volume = lines_of({"cycles", "--volume", "shells:16", "--size", "40", "--config", "tiny"});
  EXPECT_TRUE(
      std::regex_match(volume.at(0), std::regex(R"(stream: [\d,]+ bytes: splats [\d.]+ % \([\d.]+ records each\),)"
                                                R"(.* tables [\d.]+ %; pixels: 25,600 bytes)")))
      << volume.at(0);
  EXPECT_TRUE(
      std::regex_match(volume.at(1), std::regex(R"(energy: [\d.]+ to [\d.]+ uJ, without .*: \w+ [\d.]+ to .*)")))
      << volume.at(1);
  const auto gaussians = lines_of({"cycles", "--gaussians", "shells:300", "--size", "64"});
  EXPECT_EQ(gaussians.at(1).find("not estimated"), std::string::npos) << gaussians.at(1);
  const auto culled =
      lines_of({"cycles", "--volume", "shells:16", "--size", "40", "--config", "tiny", "--set", "cull.map=block"});
  EXPECT_NE(culled.at(0).find(" cull_blocks "), std::string::npos) << culled.at(0);
  const auto densities = lines_of({"cycles", "--volume", "shells:16", "--size", "40", "--config", "fine", "--classify",
                                   "post", "--set", "classify.segment_bits=9"});
  EXPECT_EQ(densities.at(1), "energy: not estimated: the cost model leaves out classification by pixel");
}

TEST(Cycles, AreThoseOfVerifyUnderTheSamePatterns) {
  int compared = 0;
  for (const auto& [input, ready] :
       {std::pair{"always", "always"}, {"random-70", "burst-9"}, {"alternate-5", "every-3"}}) {
    const auto result_of = [&](const std::string& subcommand) {
      const auto run = fastsplat({subcommand, "--volume", "shells:16", "--size", "40", "--config", "tiny", "--input",
                                  input, "--ready", ready, "--seed", "5", "--json", "-"});
      expect_success(run);
      return json::parse(run.out);
    };
    const auto cycles = result_of("cycles")["cycles"]["actual"].get<std::uint64_t>();
    EXPECT_EQ(cycles, result_of("verify")["cycles_rtl"].get<std::uint64_t>()) << input << ' ' << ready;
    EXPECT_GT(cycles, 500U);
    ++compared;
  }
  std::printf("[figure] runs with the cycles of both verbs = %d\n", compared);
}

TEST(Cycles, TraceHoldsEverySheetOnTracksThatDoNotOverlap) {
  const TempFolder folder;
  const auto result = fastsplat({"cycles", "--volume", "shells:24", "--size", "100", "--config", "small", "--trace",
                                 folder / "t.json", "--json", "-"});
  expect_success(result);
  const auto sheets = json::parse(result.out)["sheets"].get<std::size_t>();
  const auto tiles = json::parse(result.out)["tiles"].get<std::size_t>();
  const auto trace = json::parse(read_bytes(folder.path() / "t.json"));
  std::map<int, std::vector<std::pair<std::uint64_t, std::uint64_t>>> tracks;
  std::map<int, std::string> names;
  for (const auto& event : trace["traceEvents"]) {
    if (event["name"] == "thread_name") names[event["tid"]] = event["args"]["name"];
    if (event["ph"] == "X")
      tracks[event["tid"]].emplace_back(event["ts"],
                                        event["ts"].get<std::uint64_t>() + event["dur"].get<std::uint64_t>());
  }
  ASSERT_EQ(tracks.size(), 4U);
  EXPECT_EQ(names.size(), 4U);
  for (const auto& [track, slices] : tracks) {
    EXPECT_GE(slices.size(), track == 4 ? tiles : sheets) << names[track];
    for (std::size_t i = 1; i < slices.size(); ++i) EXPECT_LE(slices[i - 1].second, slices[i].first) << names[track];
    std::printf("[figure] slices of '%s' = %zu\n", names[track].c_str(), slices.size());
  }
}

TEST(Cycles, TimelineHasEverySheetAndTileAndTheTraceStaysAsItIs) {
  const TempFolder folder;
  const Words scene{"cycles", "--volume", "shells:24", "--size", "100", "--config", "small", "--json", "-"};
  const auto run = fastsplat(with(scene, {"--timeline", "--trace", folder / "both.json"}));
  expect_success(run);
  expect_success(fastsplat(with(scene, {"--trace", folder / "alone.json"})));
  EXPECT_EQ(read_bytes(folder.path() / "both.json"), read_bytes(folder.path() / "alone.json"));
  const auto result = json::parse(run.out);
  const auto timeline = result["timeline"];
  const auto column = [&](const std::string& which, const std::string& name) {
    const auto names = timeline[which + "_columns"].get<std::vector<std::string>>();
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  EXPECT_EQ(timeline["sheets"].size(), result["sheets"]);
  EXPECT_EQ(timeline["tiles"].size(), result["tiles"]);
  std::uint64_t windows = 0, blocks = 0, last = 0;
  for (const auto& sheet : timeline["sheets"]) {
    windows += sheet.at(column("sheet", "windows")).get<std::uint64_t>();
    blocks += sheet.at(column("sheet", "blocks")).get<std::uint64_t>();
    EXPECT_LE(sheet.at(column("sheet", "begun")), sheet.at(column("sheet", "closed")));
  }
  for (const auto& tile : timeline["tiles"]) last = tile.at(column("tile", "picture_to")).get<std::uint64_t>();
  EXPECT_EQ(windows, result["windows"]);
  EXPECT_EQ(blocks, result["dirty_blocks"]);
  EXPECT_GT(windows, 0U);
  EXPECT_EQ(last, result["cycles"]["end"]);
  std::printf("[figure] windows of the timeline's sheets = %llu, last pixel before cycle %llu\n",
              static_cast<unsigned long long>(windows), static_cast<unsigned long long>(last));
}

TEST(Cycles, MisuseIsReportedBeforeAnyWork) {
  const TempFolder folder;
  expect_error(fastsplat({"cycles", "--stream", "a.fss", "--volume", "shells:8"}), 2, {"--stream", "scene"});
  expect_error(fastsplat({"cycles", "--volume", "shells:8", "--ready", "sometimes"}), 2, {"sometimes", "every-N"});
  expect_error(fastsplat({"cycles", "--stream", folder / "none.fss"}), 3, {"none.fss"});
}

TEST(Cycles, ColumnsStayApartHoweverLongItTakes) {
  const auto run =
      fastsplat({"cycles", "--volume", "shells:8", "--size", "16", "--config", "tiny", "--ready", "every-1000000"});
  expect_success(run);
  // "+ output  127,859,352 12119369.858 %  a pixel beat waits": every row's words begin in one column.
  std::set<std::size_t> columns;
  int rows = 0;
  std::istringstream lines(run.out);
  for (std::string line; std::getline(lines, line);) {
    const auto end = line.find(" %  ");
    if (end == std::string::npos || line.find("terminated") != std::string::npos) continue;
    std::istringstream words(line);
    std::string first, name, cycles, share, sign;
    if (line[0] == ' ') {
      words >> name >> cycles >> share >> sign;
    } else {
      words >> first >> name >> cycles >> share >> sign;
    }
    EXPECT_EQ(sign, "%") << line;
    columns.insert(end);
    ++rows;
  }
  std::printf("[figure] rows = %d, columns in which their words begin = %zu (expected 1)\n", rows, columns.size());
  EXPECT_GE(rows, 9);
  EXPECT_EQ(columns.size(), 1u) << run.out;
}

}  // namespace
}  // namespace fastsplat::cli_test
