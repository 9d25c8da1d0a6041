// SPDX-License-Identifier: Apache-2.0
// Broken and damaged streams at length: the device's refusals and outputs equal the model's.
#include <gtest/gtest.h>

#include <cstdio>

#include "driver/config/config_file.hpp"
#include "tests/testbench/directed_helper.hpp"

namespace fastsplat::testbench {
namespace {

// tiny and small are in coverage_test.cpp; the tables of base are long.
TEST(BrokenStreams, BaseRefusesWhatTheModelRefuses) {
  const auto config = driver::load_config("base");
  const auto result = check_refusals(config, rtl_of(config));
  expect_all(result);
  const int refused = refused_streams(result);
  std::printf("[figure] base: streams that break a rule, refused as the model refuses them = %d (limit >= 200)\n",
              refused);
  EXPECT_GE(refused, 200);
}

struct Damaged {
  const char* config;
  int streams;
};
class DamagedStreams : public ::testing::TestWithParam<Damaged> {};

TEST_P(DamagedStreams, MeetTheModelsVerdict) {
  const auto config = driver::load_config(GetParam().config);
  const auto result = check_damage(config, rtl_of(config), 2, GetParam().streams);
  expect_all(result);
  const int refused = refused_streams(result);
  std::printf(
      "[figure] %s: damaged streams = %d, refused as the model refuses them = %d, comparisons = %llu (limit > 0)\n",
      GetParam().config, GetParam().streams, refused, static_cast<unsigned long long>(result.comparisons));
  EXPECT_GT(refused, GetParam().streams / 2);
  EXPECT_LT(refused, GetParam().streams);  // some are still legal, and equal the model
}

INSTANTIATE_TEST_SUITE_P(Configurations, DamagedStreams,
                         ::testing::Values(Damaged{"tiny", 5000}, Damaged{"small", 1000}, Damaged{"base", 100}),
                         [](const auto& info_of) { return std::string(info_of.param.config); });

}  // namespace
}  // namespace fastsplat::testbench
