// SPDX-License-Identifier: Apache-2.0
// 3-D Gaussians from the command line: both engines, the files that ship, a recorded stream, and every misuse in one
// line.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Json = nlohmann::json;

const std::string kShells = FASTSPLAT_SOURCE_DIR "/docs/examples/gaussians/shells.ply";
const std::string kCloud = FASTSPLAT_SOURCE_DIR "/docs/examples/gaussians/cloud.splat";

TEST(GaussiansRun, TheDeviceIsAbove50dBOfGolden) {
  for (const std::string& file : {kShells, kCloud, std::string("shells:500")}) {
    const TempFolder folder;
    const std::vector<std::string> scene{"render", "--gaussians", file, "--size", "160x120", "--zoom", "1.3"};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), scene.begin(), scene.end());
      return fastsplat(more);
    };
    expect_success(with({"-o", folder / "golden.exr", "-o", folder / "golden.png"}));
    const Result device = with({"--engine", "cmodel", "-o", folder / "device.exr", "--json", "-"});
    expect_success(device);
    const Json json = Json::parse(device.out);
    EXPECT_EQ(json["driver"]["cut"], 0);
    EXPECT_EQ(json["driver"]["saturated"], 0);
    EXPECT_GT(json["counters"]["windows"], 100);
    EXPECT_EQ(json["counters"]["splats"], json["driver"]["records"]);
    EXPECT_EQ(json["config"]["name"], "ellipse+composite.freeze_below=7+composite.every_sample=1");
    const Result compared = fastsplat({"compare", folder / "golden.exr", folder / "device.exr", "--min-psnr", "50"});
    expect_success(compared);
    std::printf("%s:\n%s\n", file.c_str(), compared.out.substr(0, 250).c_str());
    expect_success(with({"--order", "pixels", "-o", folder / "pixels.exr"}));
  }
}

TEST(GaussiansRun, ARecordedStreamIsTheSamePicture) {
  const TempFolder folder;
  const std::vector<std::string> scene{"--gaussians", kShells, "--size", "90", "--up", "z"};
  const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), more.begin(), more.end());
    return fastsplat(words);
  };
  expect_success(with({"stream", "record"}, {"-o", folder / "a.fss"}));
  expect_success(with({"render", "--engine", "cmodel"}, {"-o", folder / "a.exr"}));
  expect_success(fastsplat({"stream", "replay", folder / "a.fss", "-o", folder / "b.exr"}));
  expect_success(fastsplat({"compare", folder / "a.exr", folder / "b.exr", "--max-lsb", "0"}));
}

// On a small device with ellipses, every sample and colours above 1: words, taps and cycles.
TEST(GaussiansRun, TheRtlIsTheModelAndTakesItsCycles) {
  const TempFolder folder;
  const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), {"--gaussians", "shells:60", "--size", "40x36", "--config",
                               FASTSPLAT_SOURCE_DIR "/configs/faults/westover.toml", "--set", "colour.int_bits=1",
                               "--set", "pixel.int_bits=1"});
    words.insert(words.end(), more.begin(), more.end());
    const Result result = fastsplat(words);
    expect_success(result);
    return result;
  };
  with({"render", "--engine", "cmodel"}, {"--raw", folder / "model.exr"});
  const Json rtl =
      Json::parse(with({"render", "--engine", "rtl", "--check"}, {"--raw", folder / "rtl.exr", "--json", "-"}).out);
  EXPECT_EQ(rtl["check"]["mismatches"], 0);
  expect_success(fastsplat({"compare", folder / "model.exr", folder / "rtl.exr", "--max-lsb", "0"}));
  const Json verified = Json::parse(with({"verify"}, {"--json", "-"}).out);
  EXPECT_EQ(verified["mismatches"], 0);
  const Json random = Json::parse(fastsplat({"verify", "--random", "2000", "--json", "-", "--config",
                                             FASTSPLAT_SOURCE_DIR "/configs/faults/westover.toml", "--set",
                                             "colour.int_bits=1", "--set", "pixel.int_bits=1"})
                                      .out);
  EXPECT_EQ(random["mismatches"], 0);
  std::printf("[figure] comparisons of random streams with colours above 1 = %d\n", random["comparisons"].get<int>());
  EXPECT_GT(random["comparisons"].get<int>(), 10000);
  const Json cycles = Json::parse(with({"cycles"}, {"--json", "-"}).out);
  std::printf("[figure] comparisons = %d (limit > 1000), cycles of the RTL = %d, of the model = %d (limit: equal)\n",
              verified["comparisons"].get<int>(), rtl["cycles_rtl"].get<int>(), cycles["cycles"]["actual"].get<int>());
  EXPECT_GT(verified["comparisons"].get<int>(), 1000);
  EXPECT_EQ(rtl["cycles_rtl"], cycles["cycles"]["actual"]);
  expect_error(fastsplat({"verify", "--gaussians", "shells:9", "--random", "9"}), 2, {"more than one thing"});
  expect_error(fastsplat({"verify", "--up", "z", "--random", "9"}), 2, {"--up"});
  expect_error(fastsplat({"cycles", "--gaussians", "shells:9", "--cull-table"}), 2, {"--cull-table"});
}

// Every command that compiles Gaussians names the flags that keep their colours, and they do.
TEST(GaussiansRun, BrightColoursNameTheirRemedy) {
  const TempFolder folder;
  std::string ply = "ply\nformat ascii 1.0\nelement vertex 1\n";
  for (const char* name : {"x", "y", "z", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3",
                           "opacity", "f_dc_0", "f_dc_1", "f_dc_2"})
    ply += std::string("property float ") + name + "\n";
  const std::string file =
      folder.write("bright.ply", ply + "end_header\n0 0 0 -2 -2 -2 1 0 0 0 4 10 1 0\n");  // red 3.3
  const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), {"--gaussians", file, "--size", "48"});
    words.insert(words.end(), more.begin(), more.end());
    return fastsplat(words);
  };
  expect_success(with({"render"}, {"-o", folder / "golden.exr"}));
  const std::string remedy =
      "--set colour.int_bits=2 --set colour.frac_bits=14 --set sheet.int_bits=3 --set "
      "pixel.int_bits=2";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"render", "--engine", "cmodel", "-o", folder / "device.exr"},
        {"stream", "record", "-o", folder / "a.fss"},
        {"cycles"}}) {
    const Result run = with(words, {});
    expect_success(run);
    EXPECT_NE(run.err.find("1 Gaussian brighter"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find(remedy), std::string::npos) << run.err;
  }
  const auto psnr = [&] {
    const Result compared = fastsplat({"compare", folder / "golden.exr", folder / "device.exr", "--json", "-"});
    return Json::parse(compared.out).at("psnr_db").get<double>();
  };
  const double before = psnr();
  std::istringstream flags(remedy);
  const Result mended = with({"render", "--engine", "cmodel", "-o", folder / "device.exr"},
                             {std::istream_iterator<std::string>(flags), {}});
  expect_success(mended);
  EXPECT_EQ(mended.err.find("warning"), std::string::npos) << mended.err;
  std::printf("[figure] clamped %.1f dB, with the flags %.1f dB\n", before, psnr());
  EXPECT_LT(before, 30.0);
  // Errors grow with colours: 3.32 times those of the lowest row of docs/techniques/gaussians.md, 74.1 dB.
  EXPECT_GT(psnr(), 74.1 - 20.0 * std::log10(3.32));
}

// Axis, anti-aliasing and colours follow the header; --up takes precedence.
TEST(GaussiansRun, FollowsTheHeader) {
  const TempFolder folder;
  const std::string ply = read_bytes(kShells);
  const auto drawn = [&](const std::string& name, const std::string& comment, const std::vector<std::string>& more) {
    const std::string path = folder.write(name + ".ply", "ply\n" + comment + ply.substr(4));
    std::vector<std::string> words{"render", "--gaussians", path, "--size", "64"};
    for (const char* ending : {".exr", ".png"}) words.insert(words.end(), {"-o", folder / (name + ending)});
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"--json", "-"});
    const Result result = fastsplat(words);
    expect_success(result);
    return Json::parse(result.out)["gaussians"];
  };
  const auto same = [&](const std::string& one, const std::string& other) {
    return fastsplat({"compare", folder / one, folder / other, "--max-lsb", "0"}).code == 0;
  };
  drawn("plain", "", {});
  drawn("up", "", {"--up", "z"});
  EXPECT_EQ(drawn("hinted", "comment Vertical Axis: z\n", {})["up"], "z");
  drawn("declared", "comment Vertical Axis: z\n", {"--up", "-y"});
  EXPECT_FALSE(same("plain.exr", "up.exr"));
  EXPECT_TRUE(same("hinted.exr", "up.exr"));
  EXPECT_TRUE(same("declared.exr", "plain.exr"));
  EXPECT_EQ(drawn("mip", "comment SplatRenderMode: mip\n", {})["antialiased"], true);
  EXPECT_FALSE(same("mip.exr", "plain.exr"));
  // The same numbers, presented otherwise.
  EXPECT_EQ(drawn("linear", "comment color_space: linear\n", {})["linear"], true);
  EXPECT_TRUE(same("linear.exr", "plain.exr"));
  EXPECT_FALSE(same("linear.png", "plain.png"));
}

TEST(GaussiansRun, DroppedRowsAreAWarning) {
  const TempFolder folder;
  std::string splat = read_bytes(kCloud);
  splat.replace(64, 4, "\xff\xff\xff\xff");
  const std::string path = folder.write("nan.splat", splat);
  const std::string said = "1 of 200 Gaussians cannot be drawn and were dropped; the first is Gaussian 2";
  const Result render =
      fastsplat({"render", "--gaussians", path, "--size", "40", "-o", folder / "a.exr", "--json", "-"});
  EXPECT_EQ(render.code, 0);
  EXPECT_NE(render.err.find("warning: nan.splat: " + said), std::string::npos) << render.err;
  EXPECT_EQ(Json::parse(render.out)["gaussians"]["count"], 199);
  EXPECT_EQ(Json::parse(render.out)["gaussians"]["remarks"].size(), 1U);
  const Result record = fastsplat({"stream", "record", "--gaussians", path, "--size", "40", "-o", folder / "a.fss"});
  EXPECT_EQ(record.code, 0);
  EXPECT_NE(record.err.find(said), std::string::npos) << record.err;
}

TEST(GaussiansRun, DamagedFilesAreExit3) {
  const TempFolder folder;
  const std::string ply = read_bytes(kShells), splat = read_bytes(kCloud);
  const auto refused = [&](const std::string& name, const std::string& bytes, const std::vector<std::string>& said) {
    const std::string path = folder.write(name, bytes);
    const auto before = folder.entries();
    for (const char* engine : {"golden", "cmodel"})
      expect_error(fastsplat({"render", "--gaussians", path, "--engine", engine, "-o", folder / "a.exr"}), 3, said);
    expect_error(fastsplat({"stream", "record", "--gaussians", path, "-o", folder / "a.fss"}), 3, said);
    EXPECT_EQ(folder.entries(), before);
  };
  refused("cut.ply", ply.substr(0, ply.size() / 2), {"cut.ply", "shorter"});
  refused("empty.ply", "", {"empty.ply", "empty"});
  refused("cut.splat", splat.substr(0, 77), {"cut.splat", "multiple of 32"});
  refused("nan.splat", std::string(64, '\xff'), {"nan.splat", "none of the 2 Gaussians", "x is not finite"});
  refused("packed.spz", "NGSP", {"packed.spz", ".spz file is truncated", "got 4"});
  std::string missing = ply;
  missing.replace(missing.find("property float opacity"), 22, "property float opacitx");
  refused("missing.ply", missing, {"missing.ply", "opacity is missing"});
  expect_error(fastsplat({"render", "--gaussians", folder / "none.ply", "-o", folder / "a.exr"}), 3, {"no such file"});
}

TEST(GaussiansRun, MisuseIsExit2) {
  struct Misuse {
    std::vector<std::string> words, said;
  };
  const TempFolder folder;
  for (const Misuse& misuse : {
           Misuse{{"--gaussians", "nothing"}, {"shells:2000"}},
           Misuse{{"--gaussians", "shells:0"}, {"out of range", "shells:2000"}},
           Misuse{{"--gaussians", "shells:9", "--volume", "shells:9"}, {"--volume", "leave it out"}},
           Misuse{{"--gaussians", "shells:9", "--scene", "demo:fire"}, {"--scene", "leave it out"}},
           Misuse{{"--gaussians", "shells:9", "--slab-width", "2"}, {"--slab-width", "leave it out"}},
           Misuse{{"--gaussians", "shells:9", "--up", "w"}, {"--up", "-y"}},
           Misuse{{"--gaussians", "shells:9", "--low-pass", "0"}, {"--low-pass", "0.01..100"}},
           Misuse{{"--gaussians", "shells:9", "--cutoff", "9"}, {"--cutoff", "1..4"}},
           Misuse{{"--gaussians", "shells:9", "--engine", "rtl", "--config", "base"}, {"base", "ellipse"}},
           Misuse{{"--gaussians", "shells:9", "--check"}, {"--check", "rtl"}},
           Misuse{{"--gaussians", "shells:9", "--engine", "cmodel", "--config", "base"}, {"base", "ellipse"}},
           Misuse{{"--gaussians", "shells:9", "--save-scene", folder / "a.toml"}, {"--save-scene"}},
           Misuse{{"--gaussians", "shells:9", "--plain"}, {"--plain"}},
           Misuse{{"--gaussians", "shells:9", "--orthographic", "--fov", "20"}, {"--fov", "--perspective"}},
           Misuse{{"--up", "z"}, {"--up", "--gaussians FILE"}},
           Misuse{{"--order", "pixels"}, {"--order", "--gaussians FILE"}},
       }) {
    std::vector<std::string> words{"render", "-o", folder / "a.exr"};
    words.insert(words.end(), misuse.words.begin(), misuse.words.end());
    expect_error(fastsplat(words), 2, misuse.said);
    EXPECT_TRUE(folder.entries().empty());
  }
}

}  // namespace
}  // namespace fastsplat::cli_test
