// SPDX-License-Identifier: Apache-2.0
// fastsplat gaussians: conversions between formats, what is printed about a scene, --strict, and misuse in one line.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kEndings{".ply", ".compressed.ply", ".splat", ".spz", ".glb"};

TEST(GaussianFilesRun, EveryFormatIsWrittenAndDrawn) {
  const TempFolder folder;
  const std::vector<std::string> size{"--size", "120x90", "--up", "z"};
  const auto draw = [&](const std::string& scene, const std::string& picture) {
    std::vector<std::string> words{"render", "--gaussians", scene, "-o", picture};
    words.insert(words.end(), size.begin(), size.end());
    expect_success(fastsplat(words));
  };
  draw("shells:2000", folder / "true.exr");
  for (const std::string& ending : kEndings) {
    const std::string file = folder / ("scene" + ending);
    const Result made = fastsplat({"gaussians", "convert", "shells:2000", file, "--json", "-"});
    expect_success(made);
    const Json json = Json::parse(made.out);
    EXPECT_EQ(json["bytes"], std::filesystem::file_size(file));
    EXPECT_EQ(json["count"], 2000);
    EXPECT_EQ(json["lost"].size(), ending == ".splat" || ending == ".glb" ? 2U : ending.ends_with(".ply") ? 0U : 1U);
    draw(file, folder / "drawn.exr");
    const Result compared =
        fastsplat({"compare", folder / "true.exr", folder / "drawn.exr", "--min-psnr", "30", "--json", "-"});
    expect_success(compared);
    std::printf("[figure] %s: %.1f bytes a Gaussian, %.1f dB\n", ending.c_str(), json["bytes_each"].get<double>(),
                Json::parse(compared.out)["psnr_db"].is_number() ? Json::parse(compared.out)["psnr_db"].get<double>() : INFINITY);
    std::filesystem::remove(folder / "drawn.exr");
  }
}

TEST(GaussianFilesRun, InfoPrintsWhatTheFileHolds) {
  const TempFolder folder;
  expect_success(fastsplat({"gaussians", "convert", "cloud:200", folder / "a.ply"}));
  const Result text = fastsplat({"gaussians", "info", folder / "a.ply"});
  expect_success(text);
  for (const char* words : {"200, harmonics to degree 1", "opacity", "widest", "declares   up z"})
    EXPECT_NE(text.out.find(words), std::string::npos) << words << "\n" << text.out;
  const Json json = Json::parse(fastsplat({"gaussians", "info", folder / "a.ply", "--json", "-"}).out);
  EXPECT_EQ(json["degree"], 1);
  EXPECT_EQ(json["up"], "z");
  EXPECT_EQ(json["largest_harmonic"].size(), 1U);
  EXPECT_LT(json["position"]["x"]["low"], json["position"]["x"]["median"]);
  EXPECT_TRUE(json["dropped"].empty());
}

TEST(GaussianFilesRun, StrictRefusesWhatIsDropped) {
  const TempFolder folder;
  const std::string file = folder / "bad.ply";
  folder.write("bad.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
               "property float opacity\nproperty float scale_0\nproperty float scale_1\nproperty float scale_2\n"
               "property float rot_0\nproperty float rot_1\nproperty float rot_2\nproperty float rot_3\n"
               "property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\nend_header\n"
               "0 0 0 1 -1 -1 -1 1 0 0 0 0 0 0\nnan 0 0 1 -1 -1 -1 1 0 0 0 0 0 0\n"
               "0 0 0 1 -1 -1 -1 0 0 0 0 0 0 0\nnan 0 0 1 -1 -1 -1 1 0 0 0 0 0 0\n");
  const Result info = fastsplat({"gaussians", "info", file, "--json", "-"});
  expect_success(info);
  const Json dropped = Json::parse(info.out)["dropped"];
  ASSERT_EQ(dropped.size(), 2U);
  EXPECT_EQ(dropped[0], Json({{"cause", "x is not finite"}, {"count", 2}, {"first", 1}}));
  EXPECT_EQ(dropped[1]["count"], 1);
  EXPECT_NE(info.err.find("3 of 4 Gaussians"), std::string::npos) << info.err;
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"gaussians", "info", file, "--strict"},
        {"gaussians", "convert", file, folder / "out.spz", "--strict"},
        {"render", "--gaussians", file, "--size", "8", "--strict", "-o", folder / "a.exr"},
        {"stream", "record", "--gaussians", file, "--size", "8", "--strict", "-o", folder / "a.fss"}}) {
    const auto before = folder.entries();
    expect_error(fastsplat(command), 3, {file, "3 of 4 Gaussians cannot be drawn", "x is not finite", "--strict"});
    EXPECT_EQ(folder.entries(), before);
  }
}

TEST(GaussianFilesRun, WhatIsNoSceneIsSaidSo) {
  const TempFolder folder;
  folder.write("x.json", "{\"a\": 1}");
  expect_error(fastsplat({"gaussians", "info", folder / "x.json"}), 3, {"x.json", "neither a file of 3-D Gaussians"});
  for (const char* name : {"none/meta.json", "none.ply", "none.json"})
    expect_error(fastsplat({"gaussians", "info", folder / name}), 3, {name, "no such file"});
}

TEST(GaussianFilesRun, ACostOfFilesWithOtherColoursIsWarnedOf) {
  const TempFolder folder;
  expect_success(fastsplat({"gaussians", "convert", "cloud:50", folder / "a.ply"}));
  std::string linear = read_bytes(folder / "a.ply");
  linear.insert(linear.find("element vertex"), "comment color_space: linear\n");
  folder.write("linear.ply", linear);
  const auto cost = [&](const char* original) {
    return fastsplat({"errors", "file", folder / original, folder / "a.ply", "--size", "32"});
  };
  const Result same = cost("a.ply"), other = cost("linear.ply");
  expect_success(same), expect_success(other);
  EXPECT_EQ(same.err.find("colours"), std::string::npos) << same.err;
  EXPECT_NE(other.err.find("declares sRGB colours, the original linear"), std::string::npos) << other.err;
}

TEST(GaussianFilesRun, ConvertCountsWhatIsClamped) {
  const TempFolder folder;
  const std::string file = folder / "wide.ply";
  folder.write("wide.ply",
               "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
               "property float opacity\nproperty float scale_0\nproperty float scale_1\nproperty float scale_2\n"
               "property float rot_0\nproperty float rot_1\nproperty float rot_2\nproperty float rot_3\n"
               "property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\nend_header\n"
               "0 0 0 1 -1 -1 9 1 0 0 0 0 0 0\n1 0 0 1 -1 -1 -1 1 0 0 0 0 0 0\n");
  const Result converted = fastsplat({"gaussians", "convert", file, folder / "a.spz", "--json", "-"});
  expect_success(converted);
  EXPECT_EQ(Json::parse(converted.out)["lost"].size(), 1U);
  EXPECT_NE(converted.err.find("a.spz: .spz holds scales from 4.54e-05 to 379: those of 1 of 2 Gaussians"),
            std::string::npos)
      << converted.err;
}

TEST(GaussianFilesRun, MisuseIsOneLine) {
  const TempFolder folder;
  expect_error(fastsplat({"gaussians", "convert", "shells:8", folder / "a.xyz"}), 2,
               {"unknown ending", ".xyz", ".spz"});
  expect_error(fastsplat({"gaussians", "convert", "shels:8", folder / "a.ply"}), 2, {"shells"});
  expect_error(fastsplat({"gaussians", "info", folder / "none.ply"}), 3, {"no such file"});
  expect_error(fastsplat({"render", "--volume", "shells:8", "--size", "8", "--strict", "-o", folder / "a.exr"}), 2,
               {"--strict", "--gaussians"});
}

}  // namespace
}  // namespace fastsplat::cli_test
