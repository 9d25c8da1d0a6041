// SPDX-License-Identifier: Apache-2.0
// Runs the program once: draws a picture with each engine, compares them, and provokes each kind of failure. The *_slow
// tests go deep.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

TEST(Smoke, GoldenModelCompare) {
  const TempFolder folder;
  expect_success(fastsplat({"render", "--volume", "shells:24", "--size", "64", "-o", folder / "g.exr"}));
  expect_success(fastsplat({"render", "--volume", "shells:24", "--size", "64", "--engine", "cmodel", "--config", "base",
                            "-o", folder / "c.exr"}));
  // The acceptance budget of the base configuration: 48 dB, 3 LSB of 8 bits.
  const auto result =
      fastsplat({"compare", folder / "g.exr", folder / "c.exr", "--min-psnr", "48", "--max-lsb", "3", "--json", "-"});
  expect_success(result);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["verdict"], "pass");
  EXPECT_GT(json["max_abs_lsb"].get<double>(), 0.0) << "two engines that agree exactly were not two engines";
  std::printf("[figure] psnr_db = %.2f (limit >= 48)\n[figure] max_abs_lsb = %.3f (limit <= 3)\n",
              json["psnr_db"].get<double>(), json["max_abs_lsb"].get<double>());
  EXPECT_EQ(fastsplat({"compare", folder / "g.exr", folder / "c.exr", "--max-lsb", "0", "--quiet"}).code, 1);
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"c.exr", "g.exr"}));
}

TEST(Smoke, EachKindOfErrorHasItsExitCode) {
  const TempFolder folder;
  expect_error(fastsplat({"render", "--sise", "9"}), 2, {"did you mean '--size'"});
  expect_error(fastsplat({"volume", "info", folder / "none.nrrd"}), 3, {"none.nrrd"});
  expect_error(fastsplat({"render", "--volume", "point:4", "-o", folder / "none/a.exr"}), 3, {"does not exist"});
}

}  // namespace
}  // namespace fastsplat::cli_test
