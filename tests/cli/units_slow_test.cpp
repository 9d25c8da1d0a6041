// SPDX-License-Identifier: Apache-2.0
// The two units of the integer model as a user sees them, and the message about cut words.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Words = std::vector<std::string>;

Result render(const TempFolder& folder, const std::string& name, const Words& more) {
  Words words{"render", "--volume", "shells:24", "--size", "48", "-o", folder / name};
  words.insert(words.end(), more.begin(), more.end());
  return fastsplat(words);
}

TEST(Units, PlainAndFastAreOnePictureAndSayWhichTheyAre) {
  const TempFolder folder;
  int compared = 0;
  for (const std::string config : {"base", "compact", "tiny"}) {
    const auto run = [&](const std::string& name, Words more) {
      more.insert(more.end(), {"--engine", "cmodel", "--config", config, "--json", folder / (name + ".json")});
      const Result result = render(folder, name + ".exr", more);
      expect_success(result);
      return result;
    };
    const Result fast = run("fast", {}), plain = run("plain", {"--plain"});
    EXPECT_NE(fast.out.find("unit: fast ("), std::string::npos) << fast.out;
    EXPECT_NE(plain.out.find("unit: plain, "), std::string::npos) << plain.out;
    EXPECT_EQ(fastsplat({"compare", folder / "fast.exr", folder / "plain.exr", "--max-lsb", "0", "--quiet"}).code, 0);
    const auto with = nlohmann::json::parse(read_bytes(folder / "fast.json"));
    const auto without = nlohmann::json::parse(read_bytes(folder / "plain.json"));
    EXPECT_GT(with["units"]["fast_tiles"], 0);
    EXPECT_EQ(without["units"]["fast_tiles"], 0);
    EXPECT_EQ(with["counters"], without["counters"]);
    compared += static_cast<int>(with["counters"].size());
  }
  std::printf("[figure] counters equal in both units = %d\n", compared);
  EXPECT_GT(compared, 0);
  expect_error(render(folder, "r.exr", {"--plain", "--engine", "rtl", "--config", "tiny"}), 2, {"--plain", "rtl"});
}

TEST(Units, GoldenDrawsTheSamePictureEitherWay) {
  const TempFolder folder;
  int compared = 0;
  for (const std::string method : {"image_aligned", "axis_aligned", "westover", "xray", "raycast"}) {
    for (const bool plain : {false, true}) {
      Words flags{"--method", method};
      if (plain) flags.push_back("--plain");
      expect_success(render(folder, plain ? "plain.exr" : "fast.exr", flags));
    }
    EXPECT_EQ(fastsplat({"compare", folder / "fast.exr", folder / "plain.exr", "--max-lsb", "0", "--quiet"}).code, 0);
    compared += 1;
  }
  std::printf("[figure] golden methods equal with and without --plain = %d\n", compared);
}

// cycles counts hidden splats as render does, and warns about odd volumes as verify does.
TEST(Units, CyclesPrintsTheSplatsOnTerminatedBlocks) {
  const TempFolder folder;
  const Words scene{"--volume", "binary-cube:32", "--tf", "ct-head", "--size", "64", "--config", "base"};
  const auto with = [&](Words words, const Words& more) {
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), more.begin(), more.end());
    return fastsplat(words);
  };
  expect_success(with({"cycles"}, {"--json", folder / "cycles.json"}));
  expect_success(with({"render", "--engine", "cmodel"}, {"-o", folder / "a.exr", "--json", folder / "render.json"}));
  const auto cycles = nlohmann::json::parse(read_bytes(folder / "cycles.json"));
  const auto render = nlohmann::json::parse(read_bytes(folder / "render.json"));
  const double share = cycles.at("hidden_share");
  std::printf("[figure] share of hidden splats = %.4f\n", share);
  EXPECT_GT(share, 0.05);
  EXPECT_DOUBLE_EQ(share, render["units"]["hidden_splats"].get<double>() / render["counters"]["splats"].get<double>());

  // render counts by bands of a tile; a splat that reaches two bands is counted once, in the first.
  const Words tall{"--volume", "binary-cube:32", "--tf",   "ct-head", "--size", "128",
                   "--config", "base",           "--json", "-",       "--quiet"};
  const auto of = [&](Words words) {
    words.insert(words.end(), tall.begin(), tall.end());
    return nlohmann::json::parse(fastsplat(words).out);
  };
  const double by_tile = of({"cycles"}).at("hidden_share");
  const auto bands = of({"render", "--engine", "cmodel", "-o", folder / "b.exr"});
  const double by_band = bands["units"]["hidden_splats"].get<double>() / bands["counters"]["splats"].get<double>();
  std::printf("[figure] by tiles %.4f, by bands %.4f\n", by_tile, by_band);
  EXPECT_GT(by_tile, 0.05);
  EXPECT_LT(by_tile, by_band);

  const auto odd = folder.write(
      "odd.nrrd",
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\nspacings: 1 nan 2\n\n1 2 3 4 5 6 7 8\n");
  for (const char* subcommand : {"cycles", "verify"}) {
    const auto run = fastsplat({subcommand, "--volume", odd, "--size", "16", "--config", "tiny"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("odd.nrrd: "), std::string::npos) << subcommand << ": " << run.err;
  }
}

TEST(Units, SaturatedSumsAreReported) {
  const TempFolder folder;
  // Every non-empty pixel is far above the range of the sheet: the plain unit draws all tiles.
  const Result cut = render(folder, "cut.exr",
                            {"--engine", "cmodel", "--config", "compact", "--method", "xray", "--xray-exposure", "50"});
  expect_success(cut);
  EXPECT_NE(cut.out.find("unit: plain, 1 tile: in each, a sum may have saturated"), std::string::npos) << cut.out;
}

TEST(Units, OpaqueIsNotALossWhereTheFormatEndsBelowOne) {
  const TempFolder folder;
  const Words opaque{"--engine", "cmodel", "--config", "tiny", "--opacity-scale", "30"};
  const Result still = render(folder, "opaque.exr", opaque);
  expect_success(still);
  EXPECT_NE(still.err.find("output words of 1.0 are 255/256"), std::string::npos) << still.err;
  EXPECT_EQ(still.err.find("output words clamped"), std::string::npos) << still.err;
  const Result xray = render(folder, "xray.exr",
                             {"--engine", "cmodel", "--config", "tiny", "--method", "xray", "--xray-exposure", "50"});
  expect_success(xray);
  EXPECT_NE(xray.err.find("output words clamped to the largest word"), std::string::npos) << xray.err;
}

}  // namespace
}  // namespace fastsplat::cli_test
