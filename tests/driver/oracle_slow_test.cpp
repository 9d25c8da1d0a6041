// SPDX-License-Identifier: Apache-2.0
// The driver against docs/numerics.md, section 8, over many random scenes and configurations.
#include <gtest/gtest.h>

#include "tests/driver/oracle_helper.hpp"

namespace fastsplat::driver {
namespace {

TEST(DriverOracleCampaign, EveryBeatOfRandomFrames) {
  test::Random random(test::seed_or(7));
  OracleFigures figures;
  compare_random_frames(random, 30, 1000, figures);
  print_and_expect_equal(figures);
  expect_all_met(figures);
}

}  // namespace
}  // namespace fastsplat::driver
