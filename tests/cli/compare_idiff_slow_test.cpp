// SPDX-License-Identifier: Apache-2.0
// Figures of compare against those of idiff, which shares only the decoders with it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

#include "base/images/image_file.hpp"
#include "base/programs.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

Image noise(int channels, unsigned seed) {
  std::mt19937 chance(seed);
  std::uniform_real_distribution<float> value(0.0f, 1.0f);
  Image image(24, 16, channels);
  for (std::size_t at = 0; at < image.data.size(); ++at)
    image.data[at] = channels == 4 && at % 4 == 3 ? 1.0f : value(chance);
  return image;
}

/// The number behind `word` in what idiff prints.
double number_after(const std::string& text, const std::string& word) {
  const auto at = text.find(word);
  return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + word.size(), nullptr);
}

TEST(CompareChecksThresholds, IdiffFindsTheSameErrors) {
  if (!in_path("idiff")) GTEST_SKIP() << "idiff (openimageio-tools) is not installed";
  const TempFolder folder;
  using images::PixelKind;
  int pairs = 0;
  for (const auto& [ending, kind] : {std::pair{".png", PixelKind::Uint8},
                                     {".png", PixelKind::Uint16},
                                     {".tif", PixelKind::Uint8},
                                     {".tif", PixelKind::Uint16},
                                     {".tif", PixelKind::Float},
                                     {".exr", PixelKind::Half},
                                     {".exr", PixelKind::Float}}) {
    for (const int channels : {1, 3, 4}) {
      SCOPED_TRACE(std::string(ending) + " " + images::to_string(kind) + " " + std::to_string(channels));
      const std::string a = folder / (std::string("a") + ending), b = folder / (std::string("b") + ending);
      images::write_image(a, noise(channels, 1), {}, {.kind = kind});
      images::write_image(b, noise(channels, 2), {}, {.kind = kind});
      const auto judge = run_words({"idiff", a, b});
      const auto ours = fastsplat({"compare", a, b, "--json", "-"});
      ASSERT_EQ(ours.code, 0) << ours.err;
      const auto json = nlohmann::json::parse(ours.out);
      // idiff prints six digits.
      const double mean = number_after(judge.out, "Mean error = "), rms = number_after(judge.out, "RMS error = "),
                   most = number_after(judge.out, "Max error  = ");
      EXPECT_NEAR(json["mean_abs_lsb"].get<double>() / 255.0, mean, 1e-5 * mean) << judge.out;
      EXPECT_NEAR(json["rmse_lsb"].get<double>() / 255.0, rms, 1e-5 * rms) << judge.out;
      EXPECT_NEAR(json["max_abs_lsb"].get<double>() / 255.0, most, 1e-5 * most) << judge.out;
      ++pairs;
    }
  }
  std::printf("[figure] pairs judged = %d (limit 21)\n", pairs);
  EXPECT_EQ(pairs, 21);
}

}  // namespace
}  // namespace fastsplat::cli_test
