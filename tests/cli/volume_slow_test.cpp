// SPDX-License-Identifier: Apache-2.0
// Messages about odd volumes, and --nan-as in every subcommand that reads volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Words = std::vector<std::string>;

/// 2 x 2 x 2 floats: 1, 2, NaN, 4, infinity, 6, 7, 8.
std::string with_holes() {
  std::string bytes = "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nendian: little\nencoding: raw\n\n";
  for (const float value : {1.0f, 2.0f, NAN, 4.0f, INFINITY, 6.0f, 7.0f, 8.0f}) {
    char raw[4];
    std::memcpy(raw, &value, 4);
    bytes.append(raw, 4);
  }
  return bytes;
}

void expect_warned(const Result& result, const Words& said) {
  expect_success(result);
  for (const auto& words : said) EXPECT_NE(result.err.find(words), std::string::npos) << words << " in " << result.err;
}

TEST(VolumeSubcommands, NanAsIsTakenWhereverVolumesAreRead) {
  const TempFolder folder;
  const auto path = folder.write("holes.nrrd", with_holes());
  const std::string scene = folder / "scene.toml";
  const std::vector<Words> readers{{"volume", "info", path},
                                   {"volume", "convert", path, folder / "whole.nrrd"},
                                   {"render", "--volume", path, "--size", "8", "-o", folder / "a.exr"},
                                   {"stream", "record", "--volume", path, "--size", "8", "-o", folder / "a.fss"},
                                   {"cycles", "--volume", path, "--size", "8"},
                                   {"verify", "--volume", path, "--size", "8", "--config", "tiny"}};
  for (const Words& reader : readers) {
    SCOPED_TRACE(reader[0] + " " + reader[1]);
    const Result without = fastsplat(reader);
    EXPECT_EQ(without.code, 3);
    EXPECT_NE(without.err.find("2 of 8 voxels are not finite"), std::string::npos) << without.err;
    EXPECT_NE(without.err.find("--nan-as 0"), std::string::npos) << without.err;
    Words with = reader;
    with.insert(with.end(), {"--nan-as", "-3.5"});
    const Result result = fastsplat(with);
    if (reader[0] == "cycles" || reader[0] == "verify") {
      expect_success(result);
    } else {
      expect_warned(result, {"holes.nrrd: 2 of 8 voxels are not finite numbers and were replaced by -3.5"});
    }
  }
  std::printf("[figure] verbs_with_nan_as = %zu\n", readers.size());
  const auto whole = nlohmann::json::parse(fastsplat({"volume", "info", folder / "whole.nrrd", "--json", "-"}).out);
  EXPECT_EQ(whole["min"], -3.5);
  EXPECT_EQ(whole["max"], 8.0);
  // A saved scene keeps it, and a flag overrides the file.
  expect_success(fastsplat({"render", "--volume", path, "--nan-as", "5", "--save-scene", scene}));
  EXPECT_NE(read_bytes(scene).find("nan_as = 5.0\n"), std::string::npos);
  expect_warned(fastsplat({"render", "--scene", scene, "--size", "8", "-o", folder / "b.exr"}), {"replaced by 5"});
  expect_warned(fastsplat({"render", "--scene", scene, "--nan-as", "2", "--size", "8", "-o", folder / "b.exr"}),
                {"replaced by 2"});
  expect_error(fastsplat({"volume", "info", path, "--nan-as", "1e39"}), 2, {"--nan-as"});
}

TEST(VolumeSubcommands, AConstantVolumeIsReported) {
  const TempFolder folder;
  const auto path = folder.write(
      "flat.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n0 0 0 0 0 0 0 0\n");
  for (const Words& reader :
       {Words{"volume", "info", path},
        {"volume", "convert", path, folder / "out.nii"},
        {"render", "--volume", path, "--size", "8", "-o", folder / "a.png"},
        {"render", "--volume", path, "--size", "8", "--orbit", "0..90", "--frames", "2", "-o", folder / "f#.png"}}) {
    SCOPED_TRACE(reader[0] + " " + reader[1]);
    const Result result = fastsplat(reader);
    expect_warned(result, {"warning", "flat.nrrd: constant volume: every voxel is 0"});
    EXPECT_EQ(result.err.find("constant"), result.err.rfind("constant")) << "said twice";
  }
  EXPECT_EQ(fastsplat({"volume", "info", "constant:4"}).err, "");  // built to be constant
}

TEST(VolumeSubcommands, InvalidSpacingsAreReported) {
  const TempFolder folder;
  expect_success(fastsplat({"volume", "convert", "shells:4", folder / "v.nii"}));
  const std::string whole = read_bytes(folder / "v.nii");
  int said = 0;
  for (const auto& [value, words] : {std::pair{0.0f, "pixdim[2] is 0, which is not a length: 1 mm"},
                                     {NAN, "pixdim[2] is nan, which is not a length: 1 mm"},
                                     {-2.0f, "pixdim[2] is -2, which is not a length: 2 mm"}}) {
    std::string bytes = whole;
    std::memcpy(&bytes[76 + 4 * 2], &value, 4);
    std::memset(&bytes[252], 0, 4);  // no qform, no sform: they would give the spacing
    expect_warned(fastsplat({"volume", "info", folder.write("odd.nii", bytes)}), {"warning", words});
    ++said;
  }
  const std::string nrrd =
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\nspacings: 1 nan 2\n\n1 2 3 4 5 6 7 8\n";
  expect_warned(fastsplat({"volume", "info", folder.write("odd.nrrd", nrrd)}),
                {"spacing of axis 2 is nan, which is not a length: 1 mm"});
  std::printf("[figure] spacings_said = %d\n", said + 1);
}

TEST(VolumeSubcommands, ANameWithALineEndIsOneLine) {
  const TempFolder folder;
  const auto path = folder.write(
      "a\nb.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n1 2 3 4 5 6 7 8\n");
  for (const Words& words :
       {Words{"volume", "info", path}, Words{"cycles", "--volume", path, "--size", "8", "--config", "tiny"}}) {
    const Result result = fastsplat(words);
    expect_success(result);
    EXPECT_NE(result.out.find("a b.nrrd"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("\nb.nrrd"), std::string::npos) << result.out;
  }
}

TEST(VolumeSubcommands, InfoSaysWhichValuesShowSomething) {
  const TempFolder folder;
  std::string header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 10 10 10\nencoding: ascii\n\n", numbers;
  for (int i = 0; i < 1000; ++i) numbers += std::to_string(i < 600 ? -1000 : i - 600) + "\n";  // 600 of air, 0..399
  const auto path = folder.write("ct.nrrd", header + numbers);
  const Result result = fastsplat({"volume", "info", path});
  expect_success(result);
  for (const char* words :
       {"-1000 to 399, as in a CT: 0 HU is 0", "1 %: -1000, 25 %: -1000, 50 %: -1000, 75 %: 149, 99 %: 389",
        "shown    -900 to 398; background to -900, 60.0 % of the voxels", "counts   [@"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
  const auto values = nlohmann::json::parse(fastsplat({"volume", "info", path, "--json", "-"}).out)["values"];
  EXPECT_EQ(values["percentiles"]["p75"], 149);
  EXPECT_EQ(values["background_voxels"], 600);
  EXPECT_EQ(values["water"], 0);
  std::size_t voxels = 0;
  for (const auto& bin : values["histogram"]) voxels += bin.get<std::size_t>();
  std::printf("[figure] voxels_counted = %zu\n", voxels);
  EXPECT_EQ(voxels, 1000U);
}

TEST(VolumeSubcommands, PresetsInHounsfieldUnitsSayWhenTheValuesAreNot) {
  const TempFolder folder;
  const std::string bytes = folder / "bytes.nrrd";
  expect_success(fastsplat({"volume", "convert", "shells:8", bytes}));
  const auto render = [&](const std::string& volume, const char* tf) {
    return fastsplat({"render", "--volume", volume, "--tf", tf, "--size", "8", "-o", folder / "a.exr"});
  };
  expect_warned(render(bytes, "bone"), {"bytes.nrrd", "'bone' is in Hounsfield units", "mapped to -1000 to 3000 HU"});
  EXPECT_EQ(render(bytes, "linear").err.find("Hounsfield"), std::string::npos);
  EXPECT_EQ(render("shells:8", "bone").err.find("Hounsfield"), std::string::npos);  // built in: no unit
}

TEST(VolumeSubcommands, InfoSaysHowAScanLies) {
  const TempFolder folder;
  const auto path = folder.write("pitched.mha",
                                 "NDims = 3\nDimSize = 2 2 2\nTransformMatrix = -1 0 0 0 -0.8 0.6 0 0.6 0.8\n"
                                 "Offset = -10 5 7\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n12345678");
  const Result result = fastsplat({"volume", "info", path});
  expect_success(result);
  EXPECT_NE(result.out.find("axes     turned by 36.9 degrees about (1, 0, 0)"), std::string::npos) << result.out;
  const auto json = nlohmann::json::parse(fastsplat({"volume", "info", path, "--json", "-"}).out);
  std::printf("[figure] turned_degrees = %.6g\n", json["turned_degrees"].get<double>());
  EXPECT_NEAR(json["turned_degrees"].get<double>(), 36.8699, 1e-4);
  EXPECT_NEAR(json["centre_mm"][0].get<double>(), 10.5, 1e-9);
}

}  // namespace
}  // namespace fastsplat::cli_test
