// A million splats, model against oracle: half on the named configurations, half on random legal ones.
#include <gtest/gtest.h>

#include "tests/cmodel/campaign_helper.hpp"

namespace fastsplat::test {
namespace {

TEST(ManyFrames, ModelEqualsOracle) {
  Random random(seed_or(4));
  Campaign total;
  const auto add = [&](const Campaign& part) {
    total.comparison += part.comparison;
    total.splats += part.splats;
  };
  const std::vector<std::string> names = config_names();
  for (const std::string& name : names)
    if (total.comparison.mismatches == 0)
      add(compare_streams(named_config(name), random, 500000 / names.size() + 1, 2000));
  int configs = 0;
  for (; total.splats < 1000000 && total.comparison.mismatches == 0; ++configs)
    add(compare_streams(random_config(random), random, 500, 500));

  print("many frames", total.comparison);
  std::printf("[figure] many frames splats = %llu (limit 1000000), random configurations = %d\n",
              static_cast<unsigned long long>(total.splats), configs);
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_GE(total.splats, 1000000U);
}

}  // namespace
}  // namespace fastsplat::test
