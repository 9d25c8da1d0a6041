// SPDX-License-Identifier: Apache-2.0
// Ellipse records among splats: every tap, pixel and counter of the model against the oracle, for every index.kind, on
// random configurations and at the limits of an ellipse's words.
#include <gtest/gtest.h>

#include "tests/cmodel/campaign_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::IndexKind;

class EllipseFrames : public ::testing::TestWithParam<IndexKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, EllipseFrames,
                         ::testing::Values(IndexKind::Rlut, IndexKind::Separable, IndexKind::Blit2d, IndexKind::Squared,
                                           IndexKind::SquaredElliptic),
                         [](const auto& param_info) { return name_of(param_info.param); });

// N-4.6-1: every index.kind except linear.
TEST_P(EllipseFrames, ModelEqualsOracleOnRandomConfigurations) {
  Random random(seed_or(71));
  Campaign total;
  const int most = GetParam() == IndexKind::Rlut ? 120 : 40;
  int configs = 0;
  for (; configs < most && total.comparison.mismatches == 0; ++configs) {
    const cmodel::Config config = random_ellipse_config(random, GetParam());
    total += compare_streams(config, random, 200, 200);
    EXPECT_EQ(total.comparison.mismatches, 0U)
        << "configuration " << configs << ": P " << config.lanes << ", pf " << config.position_frac_bits << ", g "
        << config.rlut_guard_bits << ", N " << config.radial_entries << ", f " << symbols_of(config).f;
  }
  const std::string name = "ellipses and " + name_of(GetParam());
  print(name.c_str(), total.comparison);
  print_ellipses(name.c_str(), total);
  std::printf("[figure] %s: configurations = %d\n", name.c_str(), configs);
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_GT(total.comparison.total(), 100000U);
  EXPECT_GT(total.ellipses.records, 2000U);
  EXPECT_GT(total.ellipses.weighted, 30000U);
}

// Each end of the widths that section 2 allows together: the widest q, the fewest and the most fraction bits, the
// finest and the coarsest positions, one lane and many.
TEST(EllipseLimits, WidestAndNarrowestWords) {
  Random random(seed_or(72));
  Campaign total;
  int configs = 0, widest = 0;
  for (const int lanes : {1, 2, 8, 16})
    for (const int pf : {0, 4, 9})
      for (const int entries : {64, 2048})
        for (const int guard : {0, 6, 12})
          for (const bool fine : {false, true}) {
            cmodel::Config config = named_config("base");
            config.name = "P " + std::to_string(lanes) + " pf " + std::to_string(pf) + " N " + std::to_string(entries) +
                          " g " + std::to_string(guard) + (fine ? " fine" : " coarse");
            config.lanes = lanes;
            config.tile_width = config.tile_height = 48;
            config.rlut_columns = std::min(32 * lanes, 496);
            config.position_frac_bits = pf;
            config.position_int_bits = std::min(22 - pf, 16);
            config.phases = std::min(1 << pf, 4);
            config.radial_entries = entries;
            config.rlut_guard_bits = guard;
            oracle::Symbols symbols = symbols_of(config);
            const int room = 50 - oracle::log2_of(entries) - guard - 2 * oracle::log2_of(lanes);
            symbols.f = fine ? std::min(room, cmodel::find_key("ellipse.frac_bits")->max) : 1;
            config = config_of(symbols, config.name);
            // 22 bits of a term: nl + g + 4 - 2 pf is at most 21.
            if (oracle::log2_of(entries) + guard + 4 - 2 * pf > 21) {
              EXPECT_TRUE(cmodel::first_violation(config)) << config.name;
              continue;
            }
            ASSERT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
            total += compare_streams(config, random, 60, 60);
            ASSERT_EQ(total.comparison.mismatches, 0U) << total.comparison.first << " (" << config.name << ")";
            widest += fine && symbols.f == room ? 1 : 0;
            ++configs;
          }
  print("ends of the ellipses' words", total.comparison);
  print_ellipses("ends of the ellipses' words", total);
  std::printf("[figure] ends of the ellipses' words: configurations = %d, of which with q of 60 bits = %d\n", configs,
              widest);
  EXPECT_GT(configs, 80);
  EXPECT_GT(widest, 0);
  EXPECT_GT(total.ellipses.weighted, 50000U);
  EXPECT_GT(total.ellipses.wrapped, 0U);
}

}  // namespace
}  // namespace fastsplat::test
