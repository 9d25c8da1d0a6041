// SPDX-License-Identifier: Apache-2.0
// Bins of the fill of a table's last beat, by counting words, eight to a beat.
#include <gtest/gtest.h>

#include <cstdio>
#include <set>

#include "cmodel/stream/records.hpp"
#include "testbench/coverage/coverage_collector.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

constexpr const char* kFill = "table.last_beat_of_";

/// The fills that were hit, or that are only declared.
std::set<int> fills(const testbench::Coverage& coverage, bool hit) {
  std::set<int> out;
  for (const auto& bin : coverage.bins())
    if (bin.name.rfind(kFill, 0) == 0 && (!hit || bin.hits > 0))
      out.insert(std::stoi(bin.name.substr(std::string(kFill).size())));
  return out;
}

/// Words in the last beat of a load_table record, counted in its beats.
int words_in_last_beat(std::size_t words) {
  cmodel::LoadTable table;
  table.table = cmodel::Table::Radial;
  table.words.assign(words, 1);
  std::vector<cmodel::Beat> beats;
  append(beats, table);
  int last = 0;
  for (const std::uint32_t word : beats.back()) last += word == 1 ? 1 : 0;
  return last;
}

TEST(TableFill, IsHitByTheTableThatHasIt) {
  const auto config = named_config("tiny");
  std::set<int> all;
  for (std::size_t words = 1; words <= 32; ++words) {
    testbench::Coverage coverage;
    testbench::StreamCoverage stream(config, coverage);
    cmodel::LoadTable table;
    table.table = cmodel::Table::Radial;
    table.words.assign(words, 1);
    stream.on_record(table);
    EXPECT_EQ(fills(coverage, true), std::set<int>{words_in_last_beat(words)}) << words << " words";
    all.insert(words_in_last_beat(words));
  }
  EXPECT_EQ(all, (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8}));
}

// By hand: RADIAL has 64 words, FACTOR 17, RLUT 8 rows of 2, 4, ... 16 columns.
TEST(TableFill, IsDeclaredWhereATableOfTheConfigurationHasIt) {
  const auto tiny = testbench::CoverageCollector::declare(named_config("tiny"));
  EXPECT_EQ(fills(tiny, false), (std::set<int>{1, 8}));
  // 16 words, 9, and 4 rows of 4, 8, 12, 16 columns.
  const auto mustfail = testbench::CoverageCollector::declare(named_config("faults/mustfail"));
  EXPECT_EQ(fills(mustfail, false), (std::set<int>{1, 8}));
  // 17 words, 9, 4 rows of 2, 4, ... 16 columns, and CLASSIFY's 68, ROOT's 3 2^k + 1, GLINT's 129, LIGHTING's 13.
  const auto post = testbench::CoverageCollector::declare(named_config("faults/post"));
  EXPECT_EQ(fills(post, false), (std::set<int>{1, 4, 5, 8}));
  std::printf("[figure] fills of tiny = %zu of 8, of mustfail = %zu of 8\n", fills(tiny, false).size(),
              fills(mustfail, false).size());
}

}  // namespace
}  // namespace fastsplat::test
