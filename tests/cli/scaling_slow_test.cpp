// SPDX-License-Identifier: Apache-2.0
// `fastsplat cycles --devices N --bytes-per-cycle B --clock MHZ`: one device equals the plain command, figures agree
// with each other, and the limit is the one that the case was built for.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cmodel/stream/beat.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

json result_of(const Words& words) {
  const auto run = fastsplat(Words{"cycles"} + words + Words{"--json", "-"});
  expect_success(run);
  return json::parse(run.out);
}

std::uint64_t number(const json& value) { return value.get<std::uint64_t>(); }

std::uint64_t sum(const json& values) {
  std::uint64_t total = 0;
  for (const auto& value : values) total += value.get<std::uint64_t>();
  return total;
}

/// shells:24 in tiles of 32 pixels, 16 of them.
const Words kScene{"--volume", "shells:24", "--size",        "128",   "--config",
                   "small",    "--set",     "tile.width=32", "--set", "tile.height=32"};

TEST(Scaling, OneDeviceWithoutLimitIsThePlainCommand) {
  const TempFolder folder;
  int counts = 0;
  for (const std::string config : {"base", "compact", "exact", "small", "tiny", "wide", "year2000"}) {
    for (const Words& scene : {Words{"--volume", "shells:12", "--size", "40"},
                               Words{"--volume", "shells:16", "--size", "72x33", "--method", "xray"},
                               Words{"--volume", "point:4", "--size", "33", "--method", "axis_aligned"}}) {
      for (const Words& patterns : {Words{}, Words{"--input", "random-70", "--ready", "burst-9"},
                                    Words{"--input", "alternate-5", "--ready", "every-3"}}) {
        const Words words = scene + patterns + Words{"--config", config};
        const auto plain = result_of(words), one = result_of(words + Words{"--devices", "1"});
        EXPECT_EQ(plain["cycles"], one["cycles"]) << config;
        for (const auto* key : {"tiles", "sheets", "splats", "windows", "dirty_blocks"})
          EXPECT_EQ(plain[key], one[key]);
        EXPECT_FALSE(plain.contains("scaling"));
        EXPECT_EQ(one["scaling"]["frame_cycles"], plain["cycles"]["end"]);
        counts += 5 + 3 + static_cast<int>(plain["cycles"]["account"].size() + plain["cycles"]["counters"].size());
      }
    }
  }
  std::printf("[figure] counts of the plain command and of one device compared = %d (limit >= 1000)\n", counts);
  EXPECT_GE(counts, 1000);
}

TEST(Scaling, DevicesThatFetchShareNoLink) {
  const Words words{"--volume",       "shells:32", "--size",        "64",      "--config", "small", "--set",
                    "cull.map=block", "--set",     "tile.width=16", "--fetch", "40"};
  const auto plain = result_of(words), one = result_of(words + Words{"--devices", "1"}),
             four = result_of(words + Words{"--devices", "4"});
  EXPECT_EQ(plain["cycles"], one["cycles"]);
  EXPECT_EQ(plain["culls"], four["culls"]);
  EXPECT_GT(four["scaling"]["speed_up"].get<double>(), 1.5);
  // Each fetches the tables.
  EXPECT_GT(four["scaling"]["bytes_in"].get<double>(), one["scaling"]["bytes_in"].get<double>());
  expect_error(fastsplat(Words{"cycles"} + words + Words{"--bytes-per-cycle", "40"}), 2,
               {"--fetch", "--bytes-per-cycle", "for itself"});
}

TEST(Scaling, ARecordedStreamIsItsScene) {
  const TempFolder folder;
  expect_success(fastsplat(Words{"stream", "record"} + kScene + Words{"-o", folder / "s.fss"}));
  const Words flags{"--devices", "3", "--bytes-per-cycle", "20"};
  const auto scene = result_of(kScene + flags);
  const auto stream = result_of(Words{"--stream", folder / "s.fss"} + Words(kScene.begin() + 4, kScene.end()) + flags);
  // The stream has one more record, end_frame, which comes while a picture is output.
  for (const auto* key : {"frame_cycles", "shares", "each", "limit"})
    EXPECT_EQ(scene["scaling"][key], stream["scaling"][key]);
  EXPECT_EQ(scene["cycles"]["account"], stream["cycles"]["account"]);
  EXPECT_EQ(number(scene["scaling"]["bytes_in"]) + cmodel::kBeatBytes, number(stream["scaling"]["bytes_in"]));
  EXPECT_EQ(number(stream["scaling"]["bytes_in"]), std::filesystem::file_size(folder / "s.fss"));

  const Words late{"--stream", folder / "s.fss", "--config", "small",     "--set",   "tile.width=32",
                   "--set",    "tile.height=32", "--input",  "random-30", "--ready", "burst-9"};
  EXPECT_EQ(result_of(late)["cycles"], result_of(late + Words{"--devices", "1"})["cycles"]);
}

TEST(Scaling, FiguresAgreeWithEachOther) {
  int frames = 0;
  std::map<std::string, std::uint64_t> one_device;
  for (const int devices : {1, 2, 4, 8}) {
    for (const std::string bytes : {"0", "6", "48"}) {
      const auto all = result_of(
          kScene + Words{"--devices", std::to_string(devices), "--bytes-per-cycle", bytes, "--clock", "156.25"});
      const auto& scaling = all["scaling"];
      const auto frame = number(scaling["frame_cycles"]);
      if (devices == 1) one_device[bytes] = frame;
      EXPECT_EQ(number(scaling["one_device_cycles"]), one_device[bytes]);
      EXPECT_EQ(sum(scaling["shares"]), frame * static_cast<std::uint64_t>(devices));
      EXPECT_NEAR(scaling["fps"].get<double>(), 156.25e6 / static_cast<double>(frame), 1e-6);
      EXPECT_NEAR(scaling["speed_up"].get<double>(),
                  scaling["one_device_cycles"].get<double>() / static_cast<double>(frame), 1e-9);
      EXPECT_NEAR(scaling["efficiency"].get<double>(),
                  all["cycles"]["account"]["ideal"].get<double>() / (devices * static_cast<double>(frame)), 1e-9);
      EXPECT_EQ(number(scaling["bytes_out"]), 128U * 128 * 16);
      std::vector<int> tiles;
      std::uint64_t busy = 0, last = 0;
      for (const auto& device : scaling["each"]) {
        for (const auto& tile : device["tiles"]) tiles.push_back(tile.get<int>());
        EXPECT_EQ(sum(device["account"]), number(device["busy"]));
        busy += number(device["busy"]);
        last = std::max(last, number(device["end"]));
      }
      EXPECT_EQ(last, frame);
      EXPECT_EQ(busy, number(all["cycles"]["actual"]));
      std::sort(tiles.begin(), tiles.end());
      ASSERT_EQ(tiles.size(), 16U);
      for (int tile = 0; tile < 16; ++tile) EXPECT_EQ(tiles[static_cast<std::size_t>(tile)], tile);
      ++frames;
    }
  }
  std::printf("[figure] frames whose figures agree = %d\n", frames);
}

/// A list of numbers gives the rows of each number.
TEST(Scaling, SeveralNumbersAreEachByItself) {
  int alike = 0;
  for (const std::string list : {"1,2,4,8", "3,5"}) {
    const Words flags{"--bytes-per-cycle", "40", "--clock", "200", "--devices"};
    const auto all = result_of(kScene + flags + Words{list});
    std::istringstream numbers(list);
    json last;
    std::size_t at = 0;
    for (std::string number; std::getline(numbers, number, ','); ++at) {
      last = result_of(kScene + flags + Words{number});
      EXPECT_EQ(all["by_devices"][at], last["scaling"]) << number;
      EXPECT_FALSE(last.contains("by_devices"));
      ++alike;
    }
    EXPECT_EQ(all["by_devices"].size(), at);
    EXPECT_EQ(all["scaling"], last["scaling"]);
    EXPECT_EQ(all["cycles"], last["cycles"]);
  }
  std::printf("[figure] numbers of devices alike = %d (limit >= 6)\n", alike);
  EXPECT_GE(alike, 6);

  const auto run = fastsplat(Words{"cycles"} + kScene + Words{"--devices", "1,4"});
  expect_success(run);
  for (const std::string word : {"devices             frame", "\n      1 ", "\n      4 ", "4 devices on one link"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << run.out;
}

/// The built-in limit is named, with a suggestion.
TEST(Scaling, NamesTheLimit) {
  const auto expect_limit = [](const Words& words, const std::string& name, const std::string& said) {
    const auto limit = result_of(words)["scaling"]["limit"];
    EXPECT_EQ(limit["name"], name) << limit;
    EXPECT_NE(limit["help"].get<std::string>().find(said), std::string::npos) << limit;
  };
  expect_limit(kScene + Words{"--devices", "4", "--bytes-per-cycle", "8"}, "bandwidth",
               "128 are equivalent to no limit");
  // Most devices get no tile, but more tiles would not make it faster.
  expect_limit(kScene + Words{"--devices", "40", "--bytes-per-cycle", "2"}, "bandwidth", "bytes a cycle");
  expect_limit(kScene + Words{"--devices", "1", "--input", "every-20"}, "bandwidth", "--input");
  expect_limit(kScene + Words{"--devices", "40"}, "tail", "16 tiles for 40 devices");
  expect_limit(Words{"--volume", "point:2", "--size", "500", "--zoom", "0.02", "--config", "small", "--devices", "1"},
               "pixel_out", "second set");
  expect_limit(kScene + Words{"--devices", "1", "--ready", "every-50"}, "pixel_out", "--ready");
  expect_limit(Words{"--volume", "point:2", "--size", "2", "--config", "base", "--devices", "1"}, "fill",
               "table loading");
  expect_limit(Words{"--volume", "shells:64", "--size", "128", "--config", "base", "--devices", "1"}, "work",
               "are busy");
  const auto roofline = result_of(kScene + Words{"--bytes-per-cycle", "1"})["scaling"]["roofline"];
  EXPECT_EQ(roofline["ruling"], "stream");
}

TEST(Scaling, IsReportedOnlyOnRequest) {
  const auto run = fastsplat(Words{"cycles"} + kScene);
  expect_success(run);
  EXPECT_EQ(run.out.find("roofline"), std::string::npos);
  const auto clock = fastsplat(Words{"cycles"} + kScene + Words{"--clock", "200"});
  expect_success(clock);
  for (const std::string word : {"1 device on one link without limit", "fps at 200 MHz", "limit: ", "ruling bound: "})
    EXPECT_NE(clock.out.find(word), std::string::npos) << word << clock.out;
}

TEST(Scaling, MisuseIsReportedBeforeAnyWork) {
  const TempFolder folder;
  const Words scene{"cycles", "--volume", "shells:8"};
  expect_error(fastsplat(scene + Words{"--devices", "0"}), 2, {"--devices", "1 to 64", "'0'"});
  expect_error(fastsplat(scene + Words{"--devices", "65"}), 2, {"--devices", "1 to 64", "'65'"});
  for (const std::string list : {"1,2,65", "2,2", "4,2", "1,,2", "1,2,", ",", "1,two"})
    expect_error(fastsplat(scene + Words{"--devices", list}), 2,
                 {"--devices", "1 to 64", "increasing", "'" + list + "'"});
  expect_error(fastsplat(scene + Words{"--bytes-per-cycle", "-1"}), 2, {"--bytes-per-cycle", "0 to 65536", "'-1'"});
  expect_error(fastsplat(scene + Words{"--bytes-per-cycle", "1.5"}), 2, {"--bytes-per-cycle", "'1.5'"});
  for (const std::string clock : {"0", "-5", "nan", "1e9", "fast"})
    expect_error(fastsplat(scene + Words{"--clock", clock}), 2, {"--clock", "above 0", "'" + clock + "'"});
  expect_error(fastsplat(scene + Words{"--devices", "2", "--trace", folder / "t.json"}), 2,
               {"--trace", "--devices 2", "leave out"});
  expect_error(fastsplat(scene + Words{"--devices", "1,2", "--trace", folder / "t.json"}), 2,
               {"--trace", "--devices 1,2", "leave out"});
  expect_error(fastsplat(scene + Words{"--devices", "2", "--timeline"}), 2,
               {"--timeline", "--devices 2", "leave out --devices or --timeline"});
  expect_success(fastsplat(scene + Words{"--size", "16", "--bytes-per-cycle", "9", "--trace", folder / "t.json"}));
  EXPECT_TRUE(std::filesystem::exists(folder / "t.json"));
}

}  // namespace
}  // namespace fastsplat::cli_test
