// Sheets of densities: every tap, pixel and counter of the model against the oracle on random streams, and rules that
// only such devices have.
#include <gtest/gtest.h>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

TEST(Densities, ModelEqualsOracleOnRandomConfigurations) {
  Random random(seed_or(81));
  Campaign total;
  int configs = 0;
  for (; configs < 60 && total.comparison.mismatches == 0; ++configs)
    total += compare_streams(random_density_config(random), random, 120, 120);
  print("densities", total.comparison);
  std::printf("[figure] densities: configurations = %d, splats = %llu, words compared = %llu, different = %llu\n",
              configs, static_cast<unsigned long long>(total.splats),
              static_cast<unsigned long long>(total.comparison.total()),
              static_cast<unsigned long long>(total.comparison.mismatches));
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_GT(total.comparison.total(), 100000U);
}

TEST(Densities, WhatTheRtlRefuses) {
  cmodel::Config config = named_config("tiny");
  config.classify_segment_bits = 4;
  ASSERT_FALSE(cmodel::first_violation(config));
  EXPECT_FALSE(cmodel::rtl_violation(config));
  EXPECT_FALSE(cmodel::cycle_violation(config));
  const auto refused = [](cmodel::Config wrong, const char* key) {
    ASSERT_FALSE(cmodel::first_violation(wrong)) << cmodel::first_violation(wrong)->where;
    ASSERT_TRUE(cmodel::rtl_violation(wrong)) << key;
    EXPECT_EQ(cmodel::rtl_violation(wrong)->where, key);
    EXPECT_FALSE(cmodel::cycle_violation(wrong));
  };
  cmodel::Config wrong = config;
  wrong.composite_every_sample = 1;
  refused(wrong, "composite.every_sample");
  wrong = config;
  wrong.sheet_int_bits = 8;
  refused(wrong, "sheet.int_bits");
}

}  // namespace
}  // namespace fastsplat::test
