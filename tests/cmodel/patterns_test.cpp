// SPDX-License-Identifier: Apache-2.0
// Solid patterns: every tap, pixel and counter of the model against the oracle on random streams; patterns without
// effect; rules of such devices.
#include <gtest/gtest.h>

#include "cmodel/classify/pattern_unit.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/small_stream_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"

namespace fastsplat::test {
namespace {

/// A random configuration with patterns, with or without densities.
cmodel::Config random_pattern_config(Random& random) {
  while (true) {
    cmodel::Config config = random.once_in(3) ? random_ellipse_config(random) : random_config(random);
    config.pattern_node_bits = static_cast<int>(random.between(1, 4));
    if (!random.once_in(3)) {
      config.sheet_int_bits = static_cast<int>(random.between(1, 4));
      config.sheet_frac_bits = static_cast<int>(random.between(4, std::min(16, 18 - config.sheet_int_bits)));
      config.opacity_segments = std::min(config.opacity_segments, 1 << config.sheet_frac_bits);
      config.classify_segment_bits = static_cast<int>(random.between(1, std::min(config.sheet_frac_bits, 6)));
    }
    if (!cmodel::first_violation(config)) return config;
  }
}

TEST(Patterns, ModelEqualsOracleOnRandomConfigurations) {
  Random random(seed_or(82));
  Campaign total;
  int configs = 0;
  for (; configs < 60 && total.comparison.mismatches == 0; ++configs)
    total += compare_streams(random_pattern_config(random), random, 120, 120);
  print("patterns", total.comparison);
  std::printf("[figure] patterns: configurations = %d, splats = %llu, words compared = %llu, different = %llu\n",
              configs, static_cast<unsigned long long>(total.splats),
              static_cast<unsigned long long>(total.comparison.total()),
              static_cast<unsigned long long>(total.comparison.mismatches));
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_GT(total.comparison.total(), 100000U);
}

// N-2-8: pattern.node_bits.
TEST(Patterns, WhoDoesNotHaveThem) {
  cmodel::Config config = named_config("tiny");
  ASSERT_FALSE(cmodel::rtl_violation(config));
  config.pattern_node_bits = 6;
  ASSERT_FALSE(cmodel::first_violation(config));
  ASSERT_TRUE(cmodel::rtl_violation(config));
  EXPECT_EQ(cmodel::rtl_violation(config)->where, "pattern.node_bits");
  ASSERT_TRUE(cmodel::cycle_violation(config));
  EXPECT_EQ(cmodel::cycle_violation(config)->where, "pattern.node_bits");
}

/// A stream of one empty tile (S-tile-10), with tables 8 and 9 where they have words.
std::vector<std::uint8_t> stream_with(const cmodel::Config& config, const std::vector<std::uint32_t>& nodes,
                                      const std::vector<std::uint32_t>& words) {
  LoadedTables tables;
  if (!nodes.empty()) tables[8] = nodes;
  if (!words.empty()) tables[9] = words;
  return stream_with_tables(config, 0, tables);
}

// N-6.3-2, N-6.3-3; both or neither (N-6.3-1).
// S-table-1, S-table-13.
TEST(Patterns, TablesAreChecked) {
  cmodel::Config plain = named_config("tiny"), config = plain;
  config.pattern_node_bits = 1;
  const std::vector<std::uint32_t> nodes(16, 0xFFFFFFFF), words(13, 65535);
  const auto refused = [](const cmodel::Config& of, const std::vector<std::uint32_t>& a,
                          const std::vector<std::uint32_t>& b, const char* what) {
    const Verdict verdict = model_verdict(of, stream_with(of, a, b));
    EXPECT_EQ(verdict.refused_at.has_value(), *what != 0) << what << ": " << verdict.text;
    EXPECT_NE(verdict.text.find(what), std::string::npos) << verdict.text;
    if (*what == 0) return;
    EXPECT_TRUE(oracle_verdict(of, stream_with(of, a, b)).refused_at) << what;
  };
  refused(config, nodes, words, "");
  refused(config, {}, {}, "");
  refused(config, nodes, {}, "only one of a pattern's two tables");
  refused(config, {}, words, "only one of a pattern's two tables");
  refused(plain, nodes, words, "unknown table (expected 0, 1 or 2, got 8)");
  refused(config, std::vector<std::uint32_t>(15), words, "wrong number of table words (expected 16, got 15)");
  refused(config, nodes, std::vector<std::uint32_t>(12), "wrong number of table words (expected 13, got 12)");
  for (const auto& [at, most] :
       {std::pair<std::size_t, std::uint32_t>{2, 65535}, {6, 65536}, {11, 65536}, {12, 0x3FFFFFF}}) {
    auto wrong = words;
    wrong[at] = most;
    refused(config, nodes, wrong, "");
    wrong[at] = most + 1;
    refused(config, nodes, wrong, "table word too large");
  }
  auto any = words;
  any[3] = any[4] = any[5] = 0xFFFFFFFF;
  refused(config, nodes, any, "");
}

/// A pattern of 2 x 2 x 2 nodes: v = B_x = 0 at x = 0 and `most` at x = 1, over 4 pixels.
cmodel::PatternUnit slope(const cmodel::Config& config, std::uint32_t most, std::uint32_t high, std::uint32_t amount,
                          std::uint32_t step = 1U << 22) {
  cmodel::PatternUnit unit(config);
  std::vector<std::uint32_t> nodes;
  for (int node = 0; node < 8; ++node) {
    nodes.push_back(node % 2 == 0 ? 0 : most | (most / 2) << 16);
    nodes.push_back(0);
  }
  const std::uint32_t one = 1U << 24;
  const std::vector<std::uint32_t> words{100, 0, 0, step, one, one, 0, 65536, 65536, high, 65536, 65536, amount};
  EXPECT_FALSE(unit.loaded());
  unit.load(cmodel::Table::Nodes, nodes);
  unit.load(cmodel::Table::Pattern, words);
  EXPECT_TRUE(unit.loaded());
  return unit;
}

// N-6.3-4, N-6.3-5
TEST(Patterns, LieInStraightLinesAndEndAtTheirNodes) {
  cmodel::Config config = named_config("tiny");
  config.pattern_node_bits = 1;
  const auto unit = slope(config, 65534, 32768, 1U << 17);
  // v: a quarter of 65534 a pixel from column 100 on; t_R = v/2, b_x = 2 B_x.
  const std::int64_t red[] = {0, 0, 8192, 16384, 24576, 32767, 32767};
  for (int i = 0; i < 7; ++i) {
    const auto at = unit({.x = 99 + i, .y = 7, .sheet = 0xFFFFFFFF});
    EXPECT_EQ(at.tint[0], red[i]) << i;
    EXPECT_EQ(at.tint[1], 65536);
    EXPECT_NEAR(static_cast<double>(at.lean[0]), 4.0 * static_cast<double>(red[i]), 4.0) << i;
    EXPECT_EQ(at.lean[1], 0);
  }
}

// N-6.3-4
TEST(Patterns, PlacesAreCountedTo65535) {
  cmodel::Config config = named_config("tiny");
  config.pattern_node_bits = 1;
  const auto unit = slope(config, 65534, 65536, 0, 1);  // 2^-24 of the way a pixel: 16 of 4096 at the end
  EXPECT_EQ(unit({.x = 100, .y = 0, .sheet = 0}).tint[0], 0);
  EXPECT_EQ(unit({.x = 65635, .y = 0, .sheet = 0}).tint[0], 256);
  EXPECT_EQ(unit({.x = 400000, .y = 0, .sheet = 0}).tint[0], 256);
}

// N-6.3-13
TEST(Patterns, NoTintChangesNoBit) {
  cmodel::Config config = named_config("tiny");
  config.pattern_node_bits = 1;
  cmodel::PatternUnit unit(config);
  unit.load(cmodel::Table::Nodes, std::vector<std::uint32_t>(16, 0x12345678));
  unit.load(cmodel::Table::Pattern,
            std::vector<std::uint32_t>{0, 0, 0, 9999, 1, 7, 65536, 65536, 65536, 65536, 65536, 65536, 0});
  for (std::uint32_t word = 0; word <= static_cast<std::uint32_t>(config.sheet_format().max); word += 1 + word / 64) {
    const cmodel::SheetWord sums{word, word / 2, word / 3, word};
    EXPECT_EQ(unit.tinted(sums, {.x = word % 77, .y = 3, .sheet = 1}), sums);
  }
  for (std::int64_t colour = 0; colour <= 16384; ++colour) EXPECT_EQ(unit.tinted(colour, 65536), colour);
  EXPECT_EQ(unit({.x = 5, .y = 5, .sheet = 5}).lean, (std::array<std::int64_t, 3>{}));
}

}  // namespace
}  // namespace fastsplat::test
