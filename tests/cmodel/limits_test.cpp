// SPDX-License-Identifier: Apache-2.0
// Configurations at the ends of their ranges: every corner of the word lengths, the widest and the narrowest device.
// UndefinedBehaviorSanitizer finds overflows and wrong shifts here.
#include <gtest/gtest.h>

#include "tests/cmodel/campaign_helper.hpp"

namespace fastsplat::test {
namespace {

void add(Campaign& total, const cmodel::Config& config, Random& random, std::uint64_t splats) {
  const auto violation = cmodel::first_violation(config);
  ASSERT_FALSE(violation) << one_line(*violation);
  const Campaign part = compare_streams(config, random, splats, splats);
  total += part;
  ASSERT_EQ(part.comparison.mismatches, 0U) << part.comparison.first << " (configuration " << config.name << ")";
}

TEST(Limits, EveryCornerOfTheWordLengths) {
  Random random(seed_or(10));
  Campaign total;
  int configs = 0;
  cmodel::Config config = named_config("tiny");
  for (const auto& [ci, cf] : {std::pair{0, 2}, std::pair{0, 16}, std::pair{4, 12}})
    for (const auto& [wi, wf] : {std::pair{0, 2}, std::pair{1, 2}, std::pair{0, 16}, std::pair{1, 16}})
      for (const auto& [si, sf] : {std::pair{1, 4}, std::pair{8, 4}, std::pair{8, 24}, std::pair{1, 31}})
        for (const int of : {2, 16})
          for (const int tf : {4, 20})
            for (const auto& [xi, xf] : {std::pair{0, 4}, std::pair{8, 24}, std::pair{1, 31}}) {
              config.name = "corner U" + std::to_string(ci) + "." + std::to_string(cf) + " U" + std::to_string(wi) +
                            "." + std::to_string(wf) + " U" + std::to_string(si) + "." + std::to_string(sf) + " of " +
                            std::to_string(of) + " tf " + std::to_string(tf) + " U" + std::to_string(xi) + "." +
                            std::to_string(xf);
              config.colour_int_bits = ci;
              config.colour_frac_bits = cf;
              config.radial_int_bits = wi;
              config.radial_frac_bits = wf;
              config.sheet_int_bits = si;
              config.sheet_frac_bits = sf;
              config.opacity_frac_bits = of;
              config.opacity_segments = random.once_in(2) ? 1 : 32;
              config.composite_frac_bits = tf;
              config.freeze_below = static_cast<int>(random.one_of({0, 1, 1 << (tf - 2), 1 << tf}));
              config.pixel_int_bits = xi;
              config.pixel_frac_bits = xf;
              ASSERT_NO_FATAL_FAILURE(add(total, config, random, 30));
              ++configs;
            }
  print("corners", total.comparison);
  std::printf("[figure] corners = %d configurations, %llu splats\n", configs,
              static_cast<unsigned long long>(total.splats));
  EXPECT_GT(total.comparison.total(), 0U);
}

TEST(Limits, WidestAndNarrowestDevice) {
  Random random(seed_or(11));
  Campaign total;
  cmodel::Config widest = named_config("base"), narrowest = widest;
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
    widest.*key.member = key.max;
    narrowest.*key.member = key.min;
    const std::string name = key.name;
    if (name.starts_with("index.") || name.starts_with("ellipse.") || name.starts_with("classify.") ||
        name.starts_with("pattern."))
      widest.*key.member = narrowest.*key.member = *key.neutral;
  }
  widest.name = "widest";
  widest.tile_width = widest.tile_height = 64;  // the key allows 4096, which only costs time
  widest.rlut_columns = 64;                     // of k = 4096 rows
  widest.sheet_int_bits = widest.pixel_int_bits = 1;
  widest.colour_frac_bits = 16 - widest.colour_int_bits;
  narrowest.name = "narrowest";
  narrowest.rlut_columns = 2;  // the least that can hold a radius set with k = 1
  ASSERT_NO_FATAL_FAILURE(add(total, widest, random, 100));
  ASSERT_NO_FATAL_FAILURE(add(total, narrowest, random, 1000));
  widest.name = "widest, more integer bits";
  widest.sheet_int_bits = widest.pixel_int_bits = 8;
  widest.sheet_frac_bits = widest.pixel_frac_bits = 24;
  ASSERT_NO_FATAL_FAILURE(add(total, widest, random, 100));
  narrowest.name = "tallest footprint of one lane";
  narrowest.rlut_columns = 1024;
  narrowest.position_int_bits = 16;
  ASSERT_NO_FATAL_FAILURE(add(total, narrowest, random, 1000));
  print("widest and narrowest", total.comparison);
  EXPECT_GT(total.comparison.total(), 0U);
}

}  // namespace
}  // namespace fastsplat::test
