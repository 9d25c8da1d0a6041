// SPDX-License-Identifier: Apache-2.0
// Views of merged results: tables, CSV, the Pareto front.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "analysis/sweep/columns.hpp"
#include "analysis/sweep/pareto.hpp"
#include "tests/sweep/plan_helper.hpp"

namespace fastsplat::plan_test {
namespace {

using ::testing::HasSubstr;

plan::Merged rows_of(const std::vector<std::pair<double, double>>& points) {
  plan::Merged merged{
      .name = "m",
      .title = "m",
      .hash = "h",
      .program = "p",
      .axes = {{.name = "k", .values = {}}},
      .metrics = {{"cost", "cost", "", plan::Better::Less, ""}, {"psnr", "PSNR", "dB", plan::Better::More, ""}},
      .rows = {},
      .missing = {},
      .coverage = {}};
  for (const auto& [x, y] : points) {
    plan::Row row;
    row.id = "id" + std::to_string(merged.rows.size());
    row.axes = {{"k", std::string(merged.rows.size() % 2 == 0 ? "even, \"so\"" : "odd|ly")}};
    row.metrics = {{"cost", x}, {"psnr", y}};
    row.command = "fastsplat cycles";
    merged.rows.push_back(row);
  }
  return merged;
}

std::vector<const plan::Row*> all(const plan::Merged& merged) { return plan::chosen_rows(merged, {}); }

TEST(PlanPareto, HasTheUndominatedCases) {
  std::mt19937 random(7);
  std::vector<std::pair<double, double>> points;
  for (int n = 0; n < 300; ++n) {
    const double second = random() % 40, first = random() % 40;
    points.emplace_back(first, second);
  }
  const auto merged = rows_of(points);
  const auto result =
      plan::pareto(all(merged), plan::metric_of(merged, "cost", "--x"), plan::metric_of(merged, "psnr", "--y"));
  // By the definition, pair by pair.
  const auto beats = [](const plan::Row& a, const plan::Row& b) {
    const double ax = *a.metric("cost"), ay = *a.metric("psnr"), bx = *b.metric("cost"), by = *b.metric("psnr");
    return ax <= bx && ay >= by && (ax < bx || ay > by);
  };
  std::size_t expected = 0;
  for (const auto& row : merged.rows)
    expected += std::ranges::none_of(merged.rows, [&](const auto& other) { return beats(other, row); }) ? 1 : 0;
  EXPECT_EQ(result.front.size(), expected);
  EXPECT_EQ(result.front.size() + result.beaten.size(), merged.rows.size());
  for (const auto& [row, by] : result.beaten) EXPECT_TRUE(beats(*by, *row)) << row->id << " by " << by->id;
  std::printf("[figure] front = %zu of %zu (limit > 0)\n", result.front.size(), merged.rows.size());
  ASSERT_GT(expected, 0u);
}

TEST(PlanPareto, LeavesOutRowsThatDidNotPassOrLackAFigure) {
  auto merged = rows_of({{1, 1}, {2, 2}, {3, 3}});
  merged.rows[0].status = plan::Status::Fail;
  merged.rows[1].metrics.pop_back();
  const auto result =
      plan::pareto(all(merged), plan::metric_of(merged, "cost", "--x"), plan::metric_of(merged, "psnr", "--y"));
  EXPECT_EQ(result.front.size(), 1u);
  EXPECT_EQ(result.without.size(), 2u);
  EXPECT_THAT(error_of([&] { plan::metric_of(merged, "psrn", "--y"); }), HasSubstr("did you mean 'psnr'"));
}

// "family" has a flag --kind, and every table has a column "kind".
TEST(PlanTable, AnAxisIsSeenWhateverItsName) {
  int seen = 0;
  for (const std::string name :
       {"id", "kind", "status", "message", "config_hash", "scene_hash", "program_hash", "command"}) {
    auto merged = rows_of({{1, 10}, {2, 20}});
    merged.axes[0].name = name;
    for (auto& row : merged.rows) row.axes[0].name = name, row.kind = "family";
    merged.rows[0].axes[0].value = std::string("rlut");
    merged.rows[1].status = plan::Status::Fail;
    for (const auto& columns : {std::vector<std::string>{}, std::vector<std::string>{name, "case." + name}}) {
      const auto table = plan::table_of(merged, {.columns = columns, .where = {name + "=rlut"}, .sort = {name}});
      ASSERT_EQ(table.rows.size(), 1u) << name;
      if (columns.empty()) continue;
      EXPECT_EQ(table.rows[0][0].text, "rlut") << name;
      EXPECT_NE(table.rows[0][1].text, "rlut") << name;
    }
    EXPECT_EQ(plan::table_of(merged, {}).columns.front(), name);
    ++seen;
  }
  std::printf("[figure] axes named as a fixed column that a table shows = %d (limit 8)\n", seen);
  EXPECT_EQ(seen, 8);
}

TEST(PlanTable, ChoosesSortsAndWrites) {
  const auto merged = rows_of({{3, 30}, {1, 10}, {2, 20.5}});
  const auto table = plan::table_of(merged, {.columns = {"k", "cost", "psnr"}, .sort = {"-cost"}, .most = 2});
  EXPECT_EQ(plan::to_text(table),
            "k           cost  psnr [dB]\neven, \"so\"     3         30\neven, \"so\"     2       20.5\n... and 1 more "
            "rows\n");
  EXPECT_EQ(plan::to_csv(table), "k,cost,psnr\r\n\"even, \"\"so\"\"\",3,30\r\n\"even, \"\"so\"\"\",2,20.5\r\n");
  const auto odd = plan::table_of(merged, {.columns = {"k", "cost"}, .where = {"cost=1"}});
  EXPECT_EQ(plan::to_markdown(odd), "| k | cost |\n|---|---|\n| odd\\|ly | 1 |\n");
  EXPECT_THAT(error_of([&] { plan::table_of(merged, {.columns = {"csot"}}); }), HasSubstr("did you mean 'cost'"));
}

TEST(PlanTable, ControlBytesOfValuesAreEscaped) {
  auto merged = rows_of({{3, 30}, {1, 10}});
  merged.rows[0].axes[0].value = std::string("a\x1b[31m\n|b");
  const auto table = plan::table_of(merged, {.columns = {"k", "cost"}});
  EXPECT_NE(plan::to_text(table).find("a\\x1b[31m |b  "), std::string::npos) << plan::to_text(table);
  EXPECT_NE(plan::to_markdown(table).find("| a\\x1b[31m \\|b | 3 |"), std::string::npos) << plan::to_markdown(table);
  EXPECT_NE(plan::to_csv(table).find("\"a\\x1b[31m\n|b\",3"), std::string::npos) << plan::to_csv(table);
}

}  // namespace
}  // namespace fastsplat::plan_test
