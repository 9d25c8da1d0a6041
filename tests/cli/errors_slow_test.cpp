// SPDX-License-Identifier: Apache-2.0
// fastsplat errors and errors bound as a user runs them: their output, files and refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/words_helper.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Json = nlohmann::json;

TEST(Errors, SharesAddUpAndTheWholeErrorIsThatOfCompare) {
  const TempFolder folder;
  const auto result =
      fastsplat(with({"errors", "--config", "compact", "--shapley", "--json", folder / "e.json"}, kSmall));
  expect_success(result);
  EXPECT_NE(result.out.find("% of the error"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("sum 100.0 %"), std::string::npos) << result.out;
  const Json json = Json::parse(read_bytes(folder / "e.json"));
  EXPECT_EQ(json.at("schema"), "fastsplat.errors/1");
  double shares = 0.0, groups = 0.0;
  for (const Json& step : json.at("steps")) shares += step.at("share").get<double>();
  for (const Json& group : json.at("groups")) groups += group.get<double>();
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_NEAR(groups, 1.0, 1e-9);

  for (const char* engine : {"golden", "cmodel"}) {
    Words render{"render", "--engine", engine, "-o", folder / (std::string(engine) + ".exr"), "--quiet"};
    if (std::string(engine) == "cmodel") render = with(render, {"--config", "compact"});
    expect_success(fastsplat(with(render, kSmall)));
  }
  const auto compared = fastsplat({"compare", folder / "golden.exr", folder / "cmodel.exr", "--json", "-", "--quiet"});
  expect_success(compared);
  const double rms = Json::parse(compared.out).at("rmse_lsb").get<double>();
  std::printf("[figure] RMS %.6f LSB8, of compare %.6f\n", json.at("total").at("rms_lsb8").get<double>(), rms);
  EXPECT_NEAR(json.at("total").at("rms_lsb8").get<double>(), rms, 1e-4);  // golden's floats against its doubles
}

TEST(Errors, WritesBlameAndAMapOfEveryStep) {
  const TempFolder folder;
  expect_success(
      fastsplat(with({"errors", "--quick", "--blame", folder / "blame.png", "--maps", folder / "m"}, kSmall)));
  const auto names = folder.entries();
  std::printf("[figure] files written = %zu\n", names.size());
  EXPECT_EQ(names.size(), 1u + 2u * 17u);  // 16 sets of steps and the whole error, each as .png and .exr
  for (const std::string& name : names) EXPECT_GT(std::filesystem::file_size(folder / name), 100u) << name;
}

TEST(Errors, EveryKindOfIndexIsAttributed) {
  for (const char* kind : {"linear", "squared", "squared_elliptic", "separable"}) {
    const auto result = fastsplat(with({"errors", "--quick", "--index", kind}, kSmall));
    expect_success(result);
    EXPECT_NE(result.out.find("sum 100.0 %"), std::string::npos) << kind << "\n" << result.out;
  }
}

/// A small scene that classifies after splatting.
const Words kDensities{"--volume", "marschner-lobb:12", "--tf", "ct-head", "--classify", "post", "--size", "24"};
const Words kClassifies{"--config", "fine", "--set", "classify.segment_bits=9"};

TEST(Errors, OfDensitiesHasEightStepsMoreAndTheSameErrorAsCompare) {
  const TempFolder folder;
  const auto result = fastsplat(with(
      {"errors", "--shapley", "--json", folder / "e.json", "--blame", folder / "blame.png", "--maps", folder / "m"},
      with(kDensities, kClassifies)));
  expect_success(result);
  EXPECT_NE(result.out.find("sum 100.0 %"), std::string::npos) << result.out;
  const Json json = Json::parse(read_bytes(folder / "e.json"));
  EXPECT_EQ(json.at("schema"), "fastsplat.errors/1");
  double shares = 0.0, groups = 0.0;
  std::string names;
  for (const Json& step : json.at("steps")) {
    shares += step.at("share").get<double>();
    names += step.at("name").get<std::string>() + " ";
  }
  for (const Json& group : json.at("groups")) groups += group.get<double>();
  EXPECT_EQ(names,
            "position+snap radius emission depth phi share distance index weight product sheet transfer slope normal "
            "facing phong blend shaded colour factor slab composite freeze pixel ");
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_NEAR(groups, 1.0, 1e-9);
  EXPECT_EQ(json.at("groups").size(), 6u);
  EXPECT_EQ(folder.entries().size(), 2u + 2u * 25u);  // 24 sets of steps and the whole error, each as .png and .exr

  expect_success(fastsplat(with({"render", "--engine", "golden", "-o", folder / "golden.exr", "--quiet"}, kDensities)));
  expect_success(fastsplat(
      with({"render", "--engine", "cmodel", "-o", folder / "cmodel.exr", "--quiet"}, with(kDensities, kClassifies))));
  const auto compared = fastsplat({"compare", folder / "golden.exr", folder / "cmodel.exr", "--json", "-", "--quiet"});
  expect_success(compared);
  const double rms = Json::parse(compared.out).at("rmse_lsb").get<double>();
  std::printf("[figure] densities: RMS %.6f LSB8, of compare %.6f\n", json.at("total").at("rms_lsb8").get<double>(),
              rms);
  EXPECT_GT(rms, 0.0);
  EXPECT_NEAR(json.at("total").at("rms_lsb8").get<double>(), rms, 1e-4);  // golden's floats against its doubles
}

TEST(ErrorsBound, HoldsAndSaysSo) {
  const TempFolder folder;
  const auto result = fastsplat(
      with({"errors", "bound", "--config", "small", "--json", folder / "b.json", "--maps", folder / "b"}, kSmall));
  expect_success(result);
  EXPECT_NE(result.out.find("no error exceeds its bound"), std::string::npos) << result.out;
  const Json json = Json::parse(read_bytes(folder / "b.json"));
  EXPECT_EQ(json.at("schema"), "fastsplat.bound/1");
  EXPECT_TRUE(json.at("holds").get<bool>());
  ASSERT_EQ(json.at("levels").size(), 3u);
  for (const Json& level : json.at("levels")) {
    EXPECT_EQ(level.at("over"), 0);
    EXPECT_LE(level.at("greatest_error_to_bound").get<double>(), 1.0);
  }
  EXPECT_EQ(folder.entries().size(), 1u + 2u * 3u);
}

TEST(ErrorsBound, OfOtherKindsOfIndexNeedsTheirGeometry) {
  const auto result = fastsplat(with({"errors", "bound", "--index", "linear", "--json", "-", "--quiet"}, kSmall));
  expect_success(result);
  EXPECT_EQ(Json::parse(result.out).at("levels").size(), 2u);
}

TEST(ErrorsBound, HoldsForEverySampleEllipsesAndGaussians) {
  for (const Words& words :
       {with({"--method", "westover", "--set", "composite.every_sample=1"}, kSmall),
        with({"--config", "ellipse", "--antialias", "on", "--zoom", "0.3"}, kSmall),
        Words{"--gaussians", "shells:60", "--size", "24"},
        with({"--set", "colour.int_bits=1", "--set", "colour.frac_bits=15"}, kSmall), with(kDensities, kClassifies)}) {
    const auto result = fastsplat(with({"errors", "bound", "--json", "-", "--quiet"}, words));
    expect_success(result);
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json.at("levels").size(), 3u);
    EXPECT_TRUE(json.at("holds").get<bool>());
  }
}

TEST(Errors, BadInputIsOneLine) {
  const TempFolder folder;
  const auto refused = [](const Words& words, int code, const std::string& part) {
    const auto result = fastsplat(words);
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  };
  refused(with({"errors", "--method", "westover"}, kSmall), 2, "composite.every_sample");
  refused(with({"errors", "bound", "--method", "westover"}, kSmall), 2, "composite.every_sample");
  refused(with({"errors"}, kDensities), 2, "classify.segment_bits");
  refused(
      with({"errors", "bound", "--texture", "marble", "--set", "pattern.node_bits=4"}, with(kDensities, kClassifies)),
      2, "error attribution");
  refused(with({"errors", "--texture", "marble", "--set", "pattern.node_bits=4"}, with(kDensities, kClassifies)), 2,
          "error attribution");
  refused(with({"errors", "--bump", "noise", "--set", "pattern.node_bits=4"}, with(kDensities, kClassifies)), 2,
          "error attribution");
  refused({"errors", "--volume", "no-such-volume"}, 2, "no-such-volume");
  refused(with({"errors", "--config", "no-such"}, kSmall), 2, "no-such");
  refused(with({"errors", "--blame", folder / "b.jpg"}, kSmall), 2, "b.jpg");
  refused(with({"errors", "bound", "--maps", (folder.path() / "no" / "such" / "m").string()}, kSmall), 3, "such");
  refused({"errors", "bond"}, 2, "did you mean 'bound'");
  refused(with({"errors", "--lsb-bits", "0"}, kSmall), 2, "--lsb-bits");
  refused(with({"errors", "--formats", "fp17"}, kSmall), 2, "fp17");
  refused(with({"errors", "--formats", "fp16,fp32,fp32"}, kSmall), 2, "--formats");
  refused(with({"errors", "--tile-centres"}, kSmall), 2, "--formats");
  refused(with({"errors", "--flush-subnormals"}, kSmall), 2, "--formats");
}

}  // namespace
}  // namespace fastsplat::cli_test
