// SPDX-License-Identifier: Apache-2.0
// The good paths: pictures, comparisons, JSON, streams, scenes, as a user strings them together.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Json = nlohmann::json;

std::vector<std::string> render_24(std::vector<std::string> more) {
  std::vector<std::string> all{"render", "--volume", "shells:24", "--size", "64x48"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Json parsed(const std::string& text) { return Json::parse(text); }

/// Without the times, which no two runs share: keys that end in "seconds", at any depth.
Json without_times(const Json& json) {
  if (!json.is_object()) return json;
  Json out = Json::object();
  for (const auto& [key, value] : json.items()) {
    if (!key.ends_with("seconds")) out[key] = without_times(value);
  }
  return out;
}

TEST(RenderAndCompare, GoldenAndModelAgreeWithinTheBudgetOfBase) {
  const TempFolder folder;
  expect_success(fastsplat(render_24({"-o", folder / "g.exr"})));
  expect_success(fastsplat(render_24({"--engine", "cmodel", "--config", "base", "-o", folder / "c.exr"})));
  // The acceptance budget of the base configuration: 48 dB, 3 LSB of 8 bits.
  const auto result =
      fastsplat({"compare", folder / "g.exr", folder / "c.exr", "--min-psnr", "48", "--max-lsb", "3", "--json", "-"});
  expect_success(result);
  const auto json = parsed(result.out);
  EXPECT_EQ(json["verdict"], "pass");
  for (const char* key :
       {"psnr_db", "max_abs_lsb", "mean_abs_lsb", "rmse_lsb", "bias_lsb", "p99_lsb", "ssim", "floor"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_GT(json["max_abs_lsb"].get<double>(), 0.0) << "two engines that agree exactly were not two engines";
  std::printf("[figure] psnr_db = %.2f (limit >= 48)\n[figure] max_abs_lsb = %.3f (limit <= 3)\n",
              json["psnr_db"].get<double>(), json["max_abs_lsb"].get<double>());
}

TEST(RenderAndCompare, JsonCountsUnlessToldNotTo) {
  const TempFolder folder;
  const auto drawn = [&](const std::string& picture, std::vector<std::string> more) {
    more.insert(more.end(), {"--engine", "cmodel", "--zoom", "3", "--json", "-", "--raw", folder / picture});
    const auto result = fastsplat(render_24(more));
    expect_success(result);
    return parsed(result.out);
  };
  const Json counted = drawn("counted.exr", {}), uncounted = drawn("uncounted.exr", {"--no-counters"}),
             both = drawn("both.exr", {"--no-counters", "--counters"});
  const int all = counted["driver"]["splat_records"], visible = uncounted["visible"]["splat_records"];
  std::printf("[figure] splat records = %d, of them visible = %d (limit < all)\n", all, visible);
  EXPECT_GT(visible, 0);
  EXPECT_LT(visible, all);
  EXPECT_EQ(uncounted["counters"], nullptr);
  EXPECT_FALSE(uncounted.contains("driver"));
  EXPECT_EQ(both["counters"], counted["counters"]);
  EXPECT_EQ(read_bytes(folder / "uncounted.exr"), read_bytes(folder / "counted.exr"));
  expect_error(fastsplat(render_24({"--no-counters", "-o", folder / "g.exr"})), 2, {"--no-counters", "golden"});
}

TEST(RenderAndCompare, EveryMethodRendersOnBothEngines) {
  const TempFolder folder;
  for (const std::string method : {"image_aligned", "axis_aligned", "xray"}) {
    expect_success(fastsplat(render_24({"--method", method, "-o", folder / "g.exr"})));
    expect_success(fastsplat(render_24({"--method", method, "--engine", "cmodel", "-o", folder / "c.exr"})));
    const auto result = fastsplat({"compare", folder / "g.exr", folder / "c.exr", "--min-psnr", "40"});
    EXPECT_EQ(result.code, 0) << method << "\n" << result.out;
  }
  for (const std::string method : {"westover", "raycast"}) {
    expect_success(
        fastsplat({"render", "--volume", "shells:12", "--size", "16", "--method", method, "-o", folder / "g.exr"}));
  }
}

TEST(RenderAndCompare, LimitsDecideTheExitCode) {
  const TempFolder folder;
  expect_success(fastsplat(render_24({"-o", folder / "a.exr"})));
  expect_success(fastsplat(render_24({"--azimuth", "35", "-o", folder / "b.exr"})));
  const auto same = fastsplat({"compare", folder / "a.exr", folder / "a.exr", "--max-lsb", "0", "--min-ssim", "1"});
  EXPECT_EQ(same.code, 0) << same.out;
  for (const std::vector<std::string>& limit : {std::vector<std::string>{"--max-lsb", "0.5"},
                                                {"--min-psnr", "90"},
                                                {"--max-mean-lsb", "0"},
                                                {"--max-rmse-lsb", "0"},
                                                {"--max-p99-lsb", "0.5"},
                                                {"--min-ssim", "0.9999"}}) {
    std::vector<std::string> arguments{"compare", folder / "a.exr", folder / "b.exr"};
    arguments.insert(arguments.end(), limit.begin(), limit.end());
    const auto result = fastsplat(arguments);
    EXPECT_EQ(result.code, 1) << limit[0] << "\n" << result.out << result.err;
    EXPECT_EQ(result.err, "");
    arguments.push_back("--quiet");
    const auto quiet = fastsplat(arguments);
    EXPECT_EQ(quiet.code, 1);
    EXPECT_EQ(quiet.out + quiet.err, "");
  }
}

TEST(RenderAndCompare, MapsAreWritten) {
  const TempFolder folder;
  expect_success(fastsplat(render_24({"-o", folder / "a.exr"})));
  expect_success(fastsplat(render_24({"--engine", "cmodel", "-o", folder / "b.exr"})));
  expect_success(fastsplat(
      {"compare", folder / "a.exr", folder / "b.exr", "--map", folder / "m.png", "--heat", folder / "h.png"}));
  EXPECT_EQ(read_bytes(folder / "m.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_bytes(folder / "h.png").substr(1, 3), "PNG");
}

TEST(NotComparable, IsExit4) {
  const TempFolder folder;
  expect_success(fastsplat(render_24({"-o", folder / "a.exr", "-o", folder / "a.png"})));
  expect_success(fastsplat({"render", "--volume", "shells:24", "--size", "32", "-o", folder / "b.exr"}));
  expect_error(fastsplat({"compare", folder / "a.exr", folder / "b.exr"}), 4, {"64", "48", "32"});
  expect_error(fastsplat({"compare", folder / "a.exr", folder / "a.png"}), 4, {"a.png", "sRGB"});
  expect_error(fastsplat({"compare", folder / "a.png", folder / "a.exr"}), 4, {"a.png", "sRGB"});
  expect_success(fastsplat({"compare", folder / "a.png", folder / "a.png"}));
}

TEST(Json, IsAloneOnStdoutAndTheSameInAFile) {
  const TempFolder folder;
  for (const std::vector<std::string>& arguments :
       {render_24({}),
        render_24({"--engine", "cmodel"}),
        std::vector<std::string>{"volume", "info", "shells:8"},
        {"volume", "convert", "shells:8", folder / "v.nrrd"},
        {"stream", "record", "--volume", "shells:8", "--size", "16", "-o", folder / "s.fss"},
        {"stream", "dump", folder / "s.fss"},
        {"stream", "replay", folder / "s.fss", "-o", folder / "r.exr"},
        {"config", "list"},
        {"config", "show", "base"},
        {"config", "check", "tiny"},
        {"doctor"},
        {"compare", folder / "r.exr", folder / "r.exr"}}) {
    auto to_stdout = arguments, to_file = arguments;
    to_stdout.insert(to_stdout.end(), {"--json", "-"});
    to_file.insert(to_file.end(), {"--json", folder / "out.json"});
    const auto streamed = fastsplat(to_stdout);
    expect_success(streamed);
    expect_success(fastsplat(to_file));
    Json first, second;
    ASSERT_NO_THROW(first = parsed(streamed.out)) << arguments[0] << "\n" << streamed.out;
    ASSERT_NO_THROW(second = parsed(read_bytes(folder / "out.json"))) << arguments[0];
    EXPECT_EQ(without_times(first), without_times(second)) << arguments[0];
  }
}

TEST(Json, OfARenderHoldsCountersAndProvenance) {
  const TempFolder folder;
  const auto json = parsed(
      fastsplat(render_24({"--engine", "cmodel", "--config", "small", "--json", "-", "-o", folder / "a.exr"})).out);
  EXPECT_EQ(json["config"]["name"], "small");
  EXPECT_EQ(json["config"]["hash"].get<std::string>().size(), 16u);
  EXPECT_GT(json["voxels"].get<int>(), 0);
  EXPECT_GT(json["counters"]["windows"].get<int>(), 0);
  EXPECT_EQ(json["scene"]["width"], 64);
  EXPECT_EQ(json["scene"]["height"], 48);
  EXPECT_EQ(json["outputs"][0], folder / "a.exr");
}

TEST(Quiet, SaysNothing) {
  const TempFolder folder;
  const auto result = fastsplat(render_24({"--quiet", "-o", folder / "a.exr"}));
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST(Stderr, HasNoControlSequencesWithoutATerminal) {
  const TempFolder folder;
  const auto result = fastsplat(render_24({"-o", folder / "a.exr"}));
  EXPECT_EQ(result.err.find('\033'), std::string::npos);
  EXPECT_EQ(result.err.find('\r'), std::string::npos);
}

TEST(Threads, NeverChangeAByte) {
  const TempFolder folder;
  int compared = 0;
  for (const std::string engine : {"golden", "cmodel"}) {
    for (const std::string method : {"image_aligned", "axis_aligned", "xray"}) {
      for (const std::string threads : {"1", "2", "5"}) {
        expect_success(fastsplat(render_24(
            {"--engine", engine, "--method", method, "--threads", threads, "-o", folder / ("t" + threads + ".exr")})));
      }
      for (const std::string threads : {"2", "5"}) {
        EXPECT_EQ(read_bytes(folder / "t1.exr"), read_bytes(folder / ("t" + threads + ".exr")))
            << engine << " " << method << " " << threads;
        ++compared;
      }
    }
  }
  ASSERT_EQ(compared, 12);
}

TEST(Scene, SavedAndReadBackIsTheSamePicture) {
  const TempFolder folder;
  expect_success(
      fastsplat(render_24({"--azimuth", "-70", "--perspective", "--fov", "40", "--kernel-a", "1.5", "--shading", "on",
                           "--slab-width", "0.5", "-o", folder / "a.exr", "--save-scene", folder / "s.toml"})));
  expect_success(fastsplat({"render", "--scene", folder / "s.toml", "-o", folder / "b.exr"}));
  const auto result = fastsplat({"compare", folder / "a.exr", folder / "b.exr", "--max-lsb", "0", "--json", "-"});
  EXPECT_EQ(result.code, 0) << result.out;
  expect_success(fastsplat({"render", "--scene", folder / "s.toml", "--azimuth", "10", "-o", folder / "c.exr"}));
  EXPECT_EQ(fastsplat({"compare", folder / "a.exr", folder / "c.exr", "--max-lsb", "1"}).code, 1)
      << "the flag did not override the file";
}

TEST(Stream, RecordedAndReplayedIsTheRenderedFrame) {
  const TempFolder folder;
  expect_success(fastsplat(render_24({"--engine", "cmodel", "--config", "small", "--raw", folder / "a.exr"})));
  expect_success(fastsplat(
      {"stream", "record", "--volume", "shells:24", "--size", "64x48", "--config", "small", "-o", folder / "s.fss"}));
  // The stream's hash selects the configuration.
  for (const std::vector<std::string>& config : {std::vector<std::string>{}, {"--config", "small"}}) {
    std::vector<std::string> replay{"stream", "replay", folder / "s.fss", "--raw", folder / "b.exr"};
    replay.insert(replay.end(), config.begin(), config.end());
    expect_success(fastsplat(replay));
    expect_success(fastsplat({"compare", folder / "a.exr", folder / "b.exr", "--max-lsb", "0"}));
  }
  expect_error(fastsplat({"stream", "replay", folder / "s.fss", "--set", "radial.entries=64", "-o", folder / "c.exr"}),
               3, {"s.fss", "made for another configuration"});
  const auto dump = fastsplat({"stream", "dump", folder / "s.fss", "--limit", "5"});
  EXPECT_EQ(std::count(dump.out.begin(), dump.out.end(), '\n'), 5) << dump.out;
}

TEST(Volume, ConvertedKeepsItsValues) {
  const TempFolder folder;
  expect_success(fastsplat({"volume", "convert", "shells:12", folder / "a.nrrd"}));
  expect_success(fastsplat({"volume", "convert", folder / "a.nrrd", folder / "b.nii.gz"}));
  auto before = parsed(fastsplat({"volume", "info", folder / "a.nrrd", "--json", "-"}).out);
  auto after = parsed(fastsplat({"volume", "info", folder / "b.nii.gz", "--json", "-"}).out);
  for (const char* key : {"dims", "spacing_mm", "type", "min", "max", "voxels"})
    EXPECT_EQ(before[key], after[key]) << key;
  for (const std::string name : {"a.nrrd", "b.nii.gz"}) {
    expect_success(fastsplat(
        {"render", "--volume", folder / name, "--tf", "default", "--size", "24", "-o", folder / (name + ".exr")}));
  }
  expect_success(fastsplat({"compare", folder / "a.nrrd.exr", folder / "b.nii.gz.exr", "--max-lsb", "0"}));
}

TEST(Names, WithSpacesUnicodeAndRelativePaths) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "Schädel scans — 頭");
  Surroundings inside;
  inside.folder = folder / "Schädel scans — 頭";
  expect_success(fastsplat({"volume", "convert", "shells:8", "kopf ü.nrrd"}, inside));
  expect_success(fastsplat(
      {"render", "--volume", "./kopf ü.nrrd", "--size", "8", "-o", "bild 1.exr", "--json", "zahlen 1.json"}, inside));
  expect_success(
      fastsplat({"compare", "bild 1.exr", "../Schädel scans — 頭/bild 1.exr", "--map", "karte.png"}, inside));
  expect_success(fastsplat({"render", "--volume=point:4", "--size=4", "--out=-o.exr"}, inside));
  EXPECT_TRUE(std::filesystem::exists(inside.folder / "-o.exr"));
}

TEST(Sizes, FromOnePixelToOddShapes) {
  const TempFolder folder;
  for (const std::string size : {"1", "1x7", "129x1", "131x130"}) {
    for (const std::string engine : {"golden", "cmodel"}) {
      expect_success(fastsplat(
          {"render", "--volume", "shells:8", "--size", size, "--engine", engine, "-o", folder / (engine + ".exr")}));
    }
    const auto result = fastsplat({"compare", folder / "golden.exr", folder / "cmodel.exr"});
    EXPECT_TRUE(result.code == 0) << size << result.out << result.err;
  }
}

TEST(Warnings, AnEmptyPictureIsMentioned) {
  const TempFolder folder;
  const auto result =
      fastsplat({"render", "--volume", "shells:8", "--opacity-scale", "0", "--size", "8", "-o", folder / "a.exr"});
  EXPECT_TRUE(result.code == 2 || result.err.find("warning: the picture is empty") != std::string::npos) << result.err;
}

TEST(Doctor, ReportsWhatIsInstalled) {
  const auto json = parsed(fastsplat({"doctor", "--json", "-"}).out);
  EXPECT_GT(json["processors"].get<int>(), 0);
  EXPECT_FALSE(json["libraries"]["OpenImageIO"].get<std::string>().empty());
  EXPECT_FALSE(json["configurations"].empty());
}

}  // namespace
}  // namespace fastsplat::cli_test
