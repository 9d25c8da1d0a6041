// SPDX-License-Identifier: Apache-2.0
// Sheets of densities: every tap, pixel and counter of the model against the oracle on random streams; rules of such
// devices.
#include <gtest/gtest.h>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/small_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"

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

// N-2-8: with densities; every sample beside them (M-density-2).
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

/// The rule that refuses a stream of these tables and a density tile; None if it is legal.
cmodel::StreamRule broken_rule(const cmodel::Config& config, const LoadedTables& tables) {
  const auto bytes = stream_with_tables(config, 8, tables);
  EXPECT_EQ(disagreement(config, bytes), "");
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Whole);
  try {
    for (const cmodel::Beat& beat : to_beats(bytes)) decode.feed(beat);
  } catch (const cmodel::StreamRefusal& refused) {
    return refused.rule();
  }
  return cmodel::StreamRule::None;
}

/// A word of a table that is just legal, and its illegal neighbour.
struct TableEdge {
  int table;
  std::size_t word;
  std::uint32_t legal, illegal;
};

// N-6.2-6: ranges and numbers of words; S-table-11.
TEST(Densities, TablesAreChecked) {
  cmodel::Config config = named_config("tiny");
  config.classify_segment_bits = 4;
  const std::size_t entries = 17;
  // Two sheets. TX, DX, TY, DY and c may be any word.
  LoadedTables tables{{3, std::vector<std::uint32_t>(4 * entries)},
                      {4, std::vector<std::uint32_t>(97)},
                      {5, std::vector<std::uint32_t>(129)},
                      {6, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFFFFFFFF, 0x80000000, 0x7FFFFFFF, 0xFFFFFFFF}},
                      {7, {0, 0xFFFFFFFF, 0, 0x80000000}}};
  std::vector<TableEdge> edges{{4, 0, 16384, 16385}, {4, 96, 16384, 16385}, {5, 0, 4096, 4097}, {5, 128, 4096, 4097}};
  const std::uint32_t tau = 1U << (config.sheet_int_bits + config.sheet_frac_bits);
  for (const std::size_t entry : {std::size_t{0}, entries - 1}) {
    for (std::size_t channel = 0; channel < 3; ++channel) edges.push_back({3, 4 * entry + channel, 16384, 16385});
    edges.push_back({3, 4 * entry + 3, tau - 1, tau});
  }
  for (std::size_t word = 0; word < 6; ++word) {
    edges.push_back({6, word, 16384, 16385});
    edges.push_back({6, word, 0xFFFFC000, 0xFFFFBFFF});  // -2^14
  }
  for (std::size_t word = 6; word < 9; ++word) edges.push_back({6, word, 65535, 65536});
  for (const std::size_t word : {0U, 2U})
    for (const int first : {0, 16}) edges.push_back({7, word, 4096U << first, 4097U << first});
  int refused = 0;
  for (const auto& [table, word, legal, illegal] : edges) {
    LoadedTables with = tables;
    with[table][word] = legal;
    EXPECT_EQ(broken_rule(config, with), cmodel::StreamRule::None) << table << ", word " << word << ": " << legal;
    with[table][word] = illegal;
    EXPECT_EQ(broken_rule(config, with), cmodel::StreamRule::Words) << table << ", word " << word << ": " << illegal;
    ++refused;
  }
  const auto of_words = [&](int table, std::size_t words) {
    LoadedTables with = tables;
    with[table].resize(words);
    return broken_rule(config, with);
  };
  for (const auto& [table, words] : tables) {
    for (const std::size_t wrong : {words.size() - 1, words.size() + 1}) {
      EXPECT_EQ(of_words(table, wrong), cmodel::StreamRule::Table) << table << ": " << wrong << " words";
      ++refused;
    }
  }
  for (const std::size_t sheets : {1U, 4096U}) EXPECT_EQ(of_words(7, 2 * sheets), cmodel::StreamRule::None) << sheets;
  for (const std::size_t sheets : {0U, 4097U}) {
    EXPECT_EQ(of_words(7, 2 * sheets), cmodel::StreamRule::Table) << sheets;
    ++refused;
  }
  std::printf("[figure] tables of densities refused = %d\n", refused);
}

}  // namespace
}  // namespace fastsplat::test
