// SPDX-License-Identifier: Apache-2.0
// The printed and the machine-readable report: strict JSON with the documented keys, a readable table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/compare.hpp"
#include "tests/images/image_helper.hpp"

namespace fastsplat::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(JsonReport, HasTheDocumentedKeysAndTheReportsNumbers) {
  const Image ref = images::random_image(32, 24, 4, 1);
  const CompareReport report = compare(ref, images::random_image(32, 24, 4, 2), {.lsb_bits = 10, .min_psnr_db = 48.0});
  const json parsed = json::parse(to_json(report));
  for (const char* key : {"schema",
                          "verdict",
                          "width",
                          "height",
                          "channels",
                          "values",
                          "nonfinite",
                          "lsb_bits",
                          "peak",
                          "psnr_db",
                          "identical",
                          "max_abs_lsb",
                          "mean_abs_lsb",
                          "rmse_lsb",
                          "bias_lsb",
                          "p99_lsb",
                          "ssim",
                          "percentiles_lsb",
                          "floor",
                          "worst",
                          "histogram",
                          "clusters",
                          "cluster_threshold_lsb",
                          "limits"}) {
    EXPECT_TRUE(parsed.contains(key)) << key;
  }
  for (const char* key : {"psnr_db", "max_abs_lsb", "mean_abs_lsb", "rmse_lsb", "bias_lsb", "p99_lsb", "ssim"}) {
    EXPECT_TRUE(parsed["floor"][key].is_number()) << key;
  }
  EXPECT_EQ(parsed["schema"], "fastsplat.compare/1");
  EXPECT_EQ(parsed["verdict"], "fail");
  EXPECT_EQ(parsed["psnr_db"], report.figures.psnr_db);
  EXPECT_EQ(parsed["bias_lsb"], report.figures.bias_lsb);
  EXPECT_EQ(parsed["p99_lsb"], report.figures.percentiles_lsb[3]);
  EXPECT_EQ(parsed["percentiles_lsb"]["p99.99"], report.figures.percentiles_lsb[5]);
  EXPECT_EQ(parsed["worst"]["error_lsb"], report.worst.error_lsb);
  EXPECT_EQ(parsed["limits"][0]["name"], "min_psnr_db");
  EXPECT_EQ(parsed["limits"][0]["ok"], false);
  std::uint64_t counted = 0;
  for (const auto& bin : parsed["histogram"]) counted += bin["count"].get<std::uint64_t>();
  EXPECT_EQ(counted, report.values);
  EXPECT_EQ(parsed["clusters"].size(), report.clusters.size());
}

TEST(JsonReport, HasNoNaNAndNoInfinity) {
  const Image image = images::random_image(8, 8, 3, 1);
  const json same = json::parse(to_json(compare(image, image, {.min_psnr_db = 48.0})));
  EXPECT_TRUE(same["psnr_db"].is_null());
  EXPECT_EQ(same["identical"], true);
  EXPECT_EQ(same["verdict"], "pass");
  Image nothing(1, 1, 1);
  nothing.data[0] = std::numeric_limits<float>::quiet_NaN();
  const json none = json::parse(to_json(compare(nothing, nothing)));
  EXPECT_TRUE(none["psnr_db"].is_null());
  EXPECT_EQ(none["identical"], false);
  EXPECT_TRUE(none["worst"].is_null());
  EXPECT_EQ(none["verdict"], "fail");
}

TEST(TextReport, ShowsFloorLimitsAndVerdict) {
  Image ref(3, 2, 4), test(3, 2, 4);
  test.pixel(1, 1)[2] = 4.0f / 255;
  ref.pixel(0, 0)[0] = test.pixel(0, 0)[0] = 0.3f;
  const std::string text = to_text(compare(ref, test, {.min_psnr_db = 30.0, .max_abs_lsb = 3.0}));
  EXPECT_THAT(text, HasSubstr("3 x 2 x 4 channels, 24 values compared; 1 LSB = 1/255, peak 1"));
  EXPECT_THAT(text, HasSubstr("measured       floor"));
  EXPECT_THAT(text, testing::ContainsRegex("max .error. LSB +4\\.000 +0\\.500"));
  EXPECT_THAT(text, HasSubstr("worst  (1, 1) B: ref 0, test 0.0156863, error +4.000 LSB"));
  EXPECT_THAT(text, testing::ContainsRegex("min_psnr_db +at least 30 +got 49\\.8[0-9]* +PASS"));
  EXPECT_THAT(text, testing::ContainsRegex("max_abs_lsb +at most  3 +got 4 +FAIL"));
  EXPECT_THAT(text, HasSubstr("verdict: FAIL"));
  const std::string same = to_text(compare(ref, ref));
  EXPECT_THAT(same, testing::ContainsRegex("PSNR +dB +inf"));
  EXPECT_THAT(same, HasSubstr("verdict: PASS"));
}

}  // namespace
}  // namespace fastsplat::analysis
