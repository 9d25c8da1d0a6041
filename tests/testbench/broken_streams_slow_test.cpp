// Broken and damaged streams at length: what a device refuses, and what comes out of it, is what the model says.
#include <gtest/gtest.h>

#include <cstdio>

#include "driver/config_file.hpp"
#include "testbench/stimulus/directed.hpp"

namespace fastsplat::testbench {
namespace {

MakeDevice rtl_of(const cmodel::Config& config) {
  return [config](cmodel::PixelSink& pixels, const RtlOptions& options) {
    return make_rtl_device(config, pixels, options);
  };
}

int told(const DirectedResult& result) {
  for (const auto& failure : result.failures) ADD_FAILURE() << failure;
  int all = 0;
  for (const auto& [rule, streams] : result.refused) {
    std::printf("[figure] %s: %d streams refused at the model's beat by the model's rule\n", rule.c_str(), streams);
    all += streams;
  }
  return all;
}

// tiny and small are in coverage_test.cpp; the tables of base are long.
TEST(BrokenStreams, BaseRefusesWhatTheModelRefuses) {
  const auto config = driver::load_config("base");
  const auto result = check_refusals(config, rtl_of(config));
  const int refused = told(result);
  for (const auto& bin : result.coverage.bins()) EXPECT_GT(bin.hits, 0u) << bin.name;
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
  const int refused = told(result);
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
