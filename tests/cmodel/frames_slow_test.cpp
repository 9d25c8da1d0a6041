// SPDX-License-Identifier: Apache-2.0
// A million splats, model against oracle: half on the named configurations, half on random legal ones.
#include <gtest/gtest.h>

#include "tests/cmodel/campaign_helper.hpp"

namespace fastsplat::test {
namespace {

TEST(ManyFrames, ModelEqualsOracle) {
  Random random(seed_or(4));
  Campaign total;
  const std::vector<std::string> names = config_names();
  for (const std::string& name : names)
    if (total.comparison.mismatches == 0)
      total += compare_streams(named_config(name), random, 500000 / names.size() + 1, 2000);
  int configs = 0;
  for (; total.splats < 1000000 && total.comparison.mismatches == 0; ++configs)
    total +=
        compare_streams(configs % 2 == 0 ? random_config(random) : random_ellipse_config(random), random, 500, 500);

  print("many frames", total.comparison);
  print_ellipses("many frames", total);
  std::printf("[figure] many frames splats = %llu (limit 1000000), random configurations = %d\n",
              static_cast<unsigned long long>(total.splats), configs);
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_GE(total.splats, 1000000U);
  EXPECT_GT(total.ellipses.weighted, 1000000U);
}

}  // namespace
}  // namespace fastsplat::test
