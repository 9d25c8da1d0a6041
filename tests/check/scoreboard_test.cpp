// SPDX-License-Identifier: Apache-2.0
// The scoreboard compares records whole: a difference in any field is reported.
#include "testbench/check/scoreboard.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

struct Record {
  cmodel::TapRecord header;
  std::vector<std::uint32_t> payload;
};

struct Difference {
  const char* what;
  std::function<void(Record&)> make;
  const char* reported;  ///< in the report
};

const std::vector<Difference>& differences() {
  static const std::vector<Difference> all{
      {"tile", [](Record& r) { r.header.tile = 8; }, "RTL has stage sheet, tile 8, sheet 3, splat 5"},
      {"sheet", [](Record& r) { r.header.sheet = 4; }, "RTL has stage sheet, tile 7, sheet 4, splat 5"},
      {"tag", [](Record& r) { r.header.tag = 6; }, "RTL has stage sheet, tile 7, sheet 3, splat 6"},
      {"x", [](Record& r) { r.header.x = -1; }, "window at (-1,2) (cycle 99)"},
      {"y", [](Record& r) { r.header.y = -1; }, "window at (1,-1) (cycle 99)"},
      {"first word", [](Record& r) { r.payload.front() = 0; }, "window at (1,2), pixel (1,2): sheet R 0xA, RTL 0x0"},
      {"last word", [](Record& r) { r.payload.back() = 0; }, "window at (1,2), pixel (2,2): sheet tau 0x11, RTL 0x0"},
      {"a word too few", [](Record& r) { r.payload.pop_back(); }, "RTL has stage sheet"}};
  return all;
}

Record sums() {
  return {.header =
              {.tap = cmodel::Tap::Sheet, .tile = 7, .sheet = 3, .tag = 5, .cycle = 99, .x = 1, .y = 2, .payload = {}},
          .payload = {10, 11, 12, 13, 14, 15, 16, 17}};
}

void show(cmodel::TapSink& to, const Record& record) {
  cmodel::TapRecord out = record.header;
  out.payload = record.payload;
  to.on_tap(out);
}

TEST(Scoreboard, PassesEqualRecords) {
  testbench::Scoreboard board;
  show(board.model(), sums());
  Record later = sums();
  later.header.cycle = 100;  // times are compared by the cycle model
  show(board.rtl(), later);
  board.finish();
  EXPECT_EQ(board.comparisons(), 1u);
  EXPECT_EQ(board.mismatches(), 0u);
}

TEST(Scoreboard, ReportsEveryDifference) {
  const auto config = named_config("tiny");
  for (const auto& difference : differences()) {
    testbench::Scoreboard board;
    Record wrong = sums();
    difference.make(wrong);
    show(board.model(), sums());
    show(board.rtl(), wrong);
    board.finish();
    EXPECT_EQ(board.mismatches(), 1u) << difference.what;
    ASSERT_TRUE(board.first() != nullptr) << difference.what;
    const std::string text = describe(config, *board.first());
    EXPECT_NE(text.find(difference.reported), std::string::npos) << difference.what << ": " << text;
  }
  std::printf("[figure] differences of a record = %zu, all seen\n", differences().size());
}

TEST(Scoreboard, SeesSurplusAndMissingTaps) {
  testbench::Scoreboard much, little;
  show(much.rtl(), sums());
  EXPECT_EQ(much.mismatches(), 1u);
  show(little.model(), sums());
  EXPECT_EQ(little.mismatches(), 0u);
  EXPECT_GT(little.backlog(), 0u);
  little.finish();
  EXPECT_EQ(little.mismatches(), 1u);
  EXPECT_EQ(little.backlog(), 0u);
}

// Thousands of records behind: no allocation per record; none lost or out of order.
TEST(Scoreboard, KeepsTheOrderOfALongBacklog) {
  constexpr std::uint32_t kRecords = 20000;
  testbench::Scoreboard board;
  Record record = sums();
  for (std::uint32_t i = 0; i < kRecords; ++i) {
    record.header.tag = i;
    record.payload.resize(1 + i % 7);
    show(board.model(), record);
  }
  for (std::uint32_t i = 0; i < kRecords; ++i) {
    record.header.tag = i;
    record.payload.resize(1 + i % 7);
    show(board.rtl(), record);
  }
  board.finish();
  EXPECT_EQ(board.comparisons(), kRecords);
  EXPECT_EQ(board.mismatches(), 0u);
}

}  // namespace
}  // namespace fastsplat::test
