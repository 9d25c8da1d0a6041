// SPDX-License-Identifier: Apache-2.0
// Every demo scene by its name: one command.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

TEST(Demos, RenderByName) {
  const TempFolder folder;
  const auto names = nlohmann::json::parse(fastsplat({"doctor", "--json", "-"}).out)["demos"];
  int rendered = 0;
  for (const std::string name : names) {
    expect_success(fastsplat({"render", "--scene", "demo:" + name, "--size", "48", "-o", folder / (name + ".exr")}));
    ++rendered;
  }
  std::printf("[figure] demo_scenes_rendered = %d (limit >= 9)\n", rendered);
  ASSERT_GE(rendered, 9);
}

TEST(Demos, TakeFlagsSequencesAndDevices) {
  const TempFolder folder;
  expect_success(
      fastsplat({"render", "--scene", "demo:footprint-resolutions", "--sequence", "-o", folder / "f.#.exr"}));
  EXPECT_EQ(folder.entries().size(), 5u);
  expect_success(fastsplat({"render", "--scene", "demo:popping-image-aligned", "--azimuth", "10", "--size", "64",
                            "--engine", "cmodel", "-o", folder / "c.exr", "--save-scene", folder / "s.toml"}));
  expect_success(fastsplat({"render", "--scene", folder / "s.toml", "--engine", "cmodel", "-o", folder / "d.exr"}));
  EXPECT_EQ(read_bytes(folder / "c.exr"), read_bytes(folder / "d.exr"));
}

TEST(Demos, AMistypedNameGetsTheNearestAsSuggestion) {
  expect_error(fastsplat({"render", "--scene", "demo:tunel", "-o", "a.exr"}), 2, {"'tunel'", "did you mean 'tunnel'"});
  expect_error(fastsplat({"render", "--scene", "demo:", "-o", "a.exr"}), 2, {"known: ", "terrain"});
  expect_error(fastsplat({"render", "--scene", "demo:terrain", "--sequence", "--frames", "3", "-o", "a.exr"}), 2,
               {"a.exr", "frame number"});
}

}  // namespace
}  // namespace fastsplat::cli_test
