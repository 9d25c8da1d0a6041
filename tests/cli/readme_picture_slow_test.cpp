// SPDX-License-Identifier: Apache-2.0
// The pictures at the top of README.md come from one run, and so do the figures below them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = FASTSPLAT_SOURCE_DIR;

/// Whether `text`, such as "68.9", is `value` rounded to as many digits.
bool rounded_to(const std::string& text, double value) {
  const auto point = text.find('.');
  const double unit = std::pow(10.0, point == text.npos ? 0.0 : -static_cast<double>(text.size() - point - 1));
  return std::abs(std::stod(text) - value) <= unit / 2;
}

TEST(ReadmePicture, PicturesAndCaptionAreOfOneRun) {
  if (fastsplat({"volume", "info", "ch2bet"}).code != 0) GTEST_SKIP() << "mricron-data is not installed";
  const std::string readme = read_bytes(kRoot / "README.md"), demo = read_bytes(kRoot / "tools/helpers/demo");
  ASSERT_NE(demo.find("--size 512 --azimuth 50 --elevation 20 --zoom 1.9"), demo.npos) << "the demo has another view";
  const TempFolder folder;
  expect_success(fastsplat({"render", "--volume", "ch2bet", "--tf", "mri-head", "--size", "512", "--azimuth", "50",
                            "--elevation", "20", "--zoom", "1.9", "--save-scene", folder / "scene.toml", "-o",
                            folder / "golden.exr", "-o", folder / "golden.png"}));
  expect_success(fastsplat({"render", "--scene", folder / "scene.toml", "--engine", "cmodel", "--config", "base", "-o",
                            folder / "cmodel.exr", "-o", folder / "cmodel.png"}));
  const auto compared = fastsplat({"compare", folder / "golden.exr", folder / "cmodel.exr", "--map",
                                   folder / "error-map.png", "--json", "-", "--quiet"});
  expect_success(compared);
  const auto figures = nlohmann::json::parse(compared.out);
  const double psnr = figures.at("psnr_db"), largest = figures.at("max_abs_lsb");

  std::smatch caption;
  const std::regex shape(R"(at (\d+) x (\d+): PSNR ([\d.]+) dB, largest error ([\d.]+) of an 8-bit step)");
  ASSERT_TRUE(std::regex_search(readme, caption, shape));
  std::printf("[figure] readme_psnr = %.4f dB (caption %s), largest = %.4f LSB8 (caption %s)\n", psnr,
              caption[3].str().c_str(), largest, caption[4].str().c_str());
  EXPECT_EQ(caption[1], "512");
  EXPECT_EQ(caption[2], "512");
  EXPECT_TRUE(rounded_to(caption[3], psnr)) << psnr;
  EXPECT_TRUE(rounded_to(caption[4], largest)) << largest;

  // The last bit of a float of golden may round to the next step of 8 bits; the device's pixels are words.
  for (const auto& [name, lsb] : {std::pair{"golden.png", "1"}, {"cmodel.png", "0"}, {"error-map.png", "1"}}) {
    const auto same = fastsplat({"compare", kRoot / "docs/images" / name, folder / name, "--max-lsb", lsb});
    EXPECT_EQ(same.code, 0) << name << ": run ./run demo, copy " << name << " from demo/ to docs/images/\n"
                            << same.out << same.err;
  }
}

}  // namespace
}  // namespace fastsplat::cli_test
