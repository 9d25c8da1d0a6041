// SPDX-License-Identifier: Apache-2.0
// RTL of the pixel stage's lane against the model's unit, pixel by pixel: 0 LSB.
#include <gtest/gtest.h>

#include <cstdio>

#include "Vfs_classify_lane_narrow.h"
#include "Vfs_classify_lane_wide.h"
#include "driver/config/config_file.hpp"
#include "tests/classify/lane_bench_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

template <class Top>
void equals_the_model(const char* what, const char* file) {
  const cmodel::Config config = driver::load_config(file);
  LaneBench<Top> bench(config);
  const LaneResult result = bench.run(1, 250);
  std::printf("[figure] lane of densities, sheets of %d bits: pixels = %llu, different = %d (limit 0)\n",
              config.sheet_int_bits + config.sheet_frac_bits, static_cast<unsigned long long>(result.pixels),
              result.different.empty() ? 0 : 1);
  EXPECT_EQ(result.different, "") << what;
  EXPECT_GT(result.pixels, 0U);
}

TEST(DensityLane, EqualsTheModelOfNarrowSheets) {
  equals_the_model<Vfs_classify_lane_narrow>("narrow", FASTSPLAT_SOURCE_DIR "/configs/faults/post.toml");
}
TEST(DensityLane, EqualsTheModelOfWideSheets) {
  equals_the_model<Vfs_classify_lane_wide>("wide", FASTSPLAT_SOURCE_DIR "/tests/mutants/densities.toml");
}

}  // namespace
}  // namespace fastsplat::test
