// SPDX-License-Identifier: Apache-2.0
// Plans run and merged: finished cases are skipped, failures are reported, and the bytes do not depend on the order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "analysis/sweep/merged.hpp"
#include "analysis/sweep/status.hpp"
#include "base/json_text.hpp"
#include "tests/sweep/plan_helper.hpp"

namespace fastsplat::plan_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kFive = "kind = \"cycles\"\n[axes]\nn = [1, 2, 3, 4, 5]\n";

std::string merged(const Folder& folder, const plan::Plan& plan, const std::string& results = "results") {
  return json_text(plan::to_json(plan::merge(plan, folder / results, {})), 1);
}

std::size_t runs(const Folder& folder) {
  const std::string log = read(folder / "log");
  return static_cast<std::size_t>(std::ranges::count(log, '\n'));
}

TEST(PlanRun, SkipsFinishedCasesAndRepeatsDamagedOnes) {
  const Folder folder;
  const auto plan = plan_of(folder, kFive);
  const std::string program = script(folder);
  const auto first = run(folder, plan, program);
  EXPECT_EQ(first.passed, 5u);
  const std::string whole = merged(folder, plan);
  const auto second = run(folder, plan, program);
  EXPECT_EQ(second.skipped, 5u);
  EXPECT_EQ(runs(folder), 5u);
  const auto path = plan::result_path(folder / "results", plan.cases[2].id);
  const std::string bytes = read(path);
  std::string bad = bytes;
  bad.replace(bad.find("\"actual\": 3"), 11, "\"actual\": 4");
  for (const auto& damaged : {bytes.substr(0, bytes.size() / 2), bad, std::string()}) {
    folder.write("results/" + plan.cases[2].id + ".json", damaged);
    EXPECT_THAT(
        error_of([&] { merged(folder, plan); }),
        HasSubstr(plan.cases[2].id + ".json: " + (damaged.empty() ? "the file is empty" : "not a complete result")));
    const auto partial = plan::merge(plan, folder / "results", {.partial = true});
    EXPECT_EQ(partial.rows.size(), 4u);
    EXPECT_EQ(partial.missing, std::vector{plan.cases[2].id});
    EXPECT_EQ(run(folder, plan, program).skipped, 4u);
    EXPECT_EQ(merged(folder, plan), whole);
  }
  std::printf("[figure] runs = %zu (limit = 8)\n", runs(folder));
  EXPECT_EQ(runs(folder), 8u);
  EXPECT_TRUE(fs::is_empty(folder / "results" / ".scratch"));
}

TEST(PlanRun, ShardsAndJobsInAnyOrderGiveTheSameBytes) {
  const Folder folder;
  const auto plan = plan_of(folder, kFive);
  const std::string program = script(folder);
  run(folder, plan, program, "one");
  for (const std::size_t index : {3u, 1u, 2u}) run(folder, plan, program, "three", {index, 3}, 2);
  EXPECT_EQ(merged(folder, plan, "one"), merged(folder, plan, "three"));
  EXPECT_EQ(results_in(folder / "one"), results_in(folder / "three"));
  EXPECT_EQ(runs(folder), 10u);
}

TEST(PlanRun, AFailingCaseIsAResultAndTheOthersGoOn) {
  const Folder folder;
  const auto plan = plan_of(folder, "kind = \"cycles\"\n[axes]\nn = [1, 13, 99, 2]\n");
  const std::string program = script(folder);
  const auto summary = run(folder, plan, program);
  EXPECT_EQ(summary.passed, 2u);
  EXPECT_EQ(summary.failed, 1u);
  EXPECT_EQ(summary.errors, 1u);
  EXPECT_EQ(summary.accidents, 0u);
  const auto rows = plan::merge(plan, folder / "results", {}).rows;
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1].message, "cycles: 13 mismatches");
  EXPECT_EQ(rows[1].metric("cycles"), 13.0) << "the figures of what is over a limit stand";
  EXPECT_EQ(rows[2].message, "`cycles`: --n: no such n");
  EXPECT_EQ(run(folder, plan, program).skipped, 4u);
  EXPECT_EQ(runs(folder), 4u);
}

/// Disk, memory, signals, a crash, a missing module: not a result; all are run again.
TEST(PlanRun, FailuresOfTheMachineAreNotResults) {
  const Folder folder;
  const auto plan = plan_of(folder, "kind = \"cycles\"\n[axes]\nn = [1, 66, 70, 71, 72, 73, 75, 126, 139]\n");
  const std::string program = script(folder);
  std::vector<std::string> messages;
  plan::RunOptions options{.results = folder / "results", .program = executed(program), .program_hash = "p"};
  options.accident = [&](const plan::Case&, const std::string& message) { messages.push_back(message); };
  const auto summary = plan::run(plan, options);
  EXPECT_EQ(summary.passed, 1u);
  EXPECT_EQ(summary.errors + summary.failed, 0u);
  EXPECT_EQ(summary.accidents, 8u);
  ASSERT_EQ(messages.size(), 8u);
  EXPECT_EQ(messages[0], "`cycles` was ended by signal 9");
  EXPECT_THAT(messages[1], HasSubstr("No space left on device"));
  EXPECT_THAT(messages[2], HasSubstr("exit code 0 without JSON"));
  EXPECT_THAT(messages[3], HasSubstr("without readable JSON"));
  EXPECT_THAT(messages[4], HasSubstr("exit code 1 without JSON"));
  EXPECT_EQ(results_in(folder / "results").size(), 1u);
  EXPECT_EQ(plan::status_of(plan, folder / "results", "p", 0).all.missing, 8u);
  EXPECT_THAT(error_of([&] { merged(folder, plan); }), HasSubstr("8 of 9 results missing"));
  folder.write("mended", "");
  EXPECT_EQ(run(folder, plan, program).passed, 8u) << "all but what a signal ends";
  std::printf("[figure] accidents = %zu, left = %zu (limit 1)\n", messages.size(),
              plan::merge(plan, folder / "results", {.partial = true}).missing.size());
  EXPECT_EQ(plan::merge(plan, folder / "results", {.partial = true}).missing.size(), 1u);
}

TEST(PlanRun, TheMachineFailsAllCasesOfASharedFile) {
  const Folder folder;
  const auto plan = plan_of(folder, "kind = \"compare\"\n[constants]\nn = 75\n[axes]\na.b = [1, 2, 3]\n");
  const std::string program = script(folder);
  EXPECT_EQ(run(folder, plan, program, "results", {}, 2).accidents, 3u);
  EXPECT_EQ(results_in(folder / "results").size(), 0u);
  folder.write("mended", "");
  EXPECT_EQ(run(folder, plan, program, "results", {}, 2).passed, 3u);
}

TEST(PlanRun, SharesCommonWorkAndFailsItsCasesTogether) {
  const Folder folder;
  const auto plan =
      plan_of(folder, "kind = \"compare\"\n[constants]\nvolume = \"v\"\n[axes]\nn = [1]\na.b = [1, 2, 3, 4]\n");
  run(folder, plan, script(folder), "results", {}, 3);
  EXPECT_EQ(runs(folder), 1u + 4u * 2u);
  const Folder other;
  const auto broken = plan_of(other, "kind = \"compare\"\n[constants]\nn = 99\n[axes]\na.b = [1, 2, 3]\n");
  EXPECT_EQ(run(other, broken, script(other), "results", {}, 2).errors, 3u);
  EXPECT_EQ(runs(other), 1u) << "what cannot be made is not tried for each";
}

TEST(PlanRun, TwoCopiesAtOnceDoNoHarm) {
  const Folder folder;
  const auto plan = plan_of(folder, kFive);
  const std::string program = script(folder, "sleep 0.02");
  run(folder, plan, program, "alone");
  std::vector<pid_t> copies;
  for (int copy = 0; copy < 2; ++copy) {
    copies.push_back(::fork());
    if (copies.back() == 0) ::_exit(run(folder, plan, program, "both").passed == 5 ? 0 : 1);
  }
  for (const pid_t copy : copies) {
    int status = -1;
    ::waitpid(copy, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(results_in(folder / "alone"), results_in(folder / "both"));
  std::printf("[figure] runs_of_both = %zu (limit > 5)\n", runs(folder) - 5);
  EXPECT_GT(runs(folder) - 5, 5u) << "they were not at work together";
}

TEST(PlanMerge, NamesMissingAndForeignResults) {
  const Folder folder;
  const auto plan = plan_of(folder, kFive);
  const std::string program = script(folder);
  run(folder, plan, program, "results", {1, 2});
  const auto message = error_of([&] { merged(folder, plan); });
  EXPECT_THAT(message, HasSubstr("2 of 5 results missing: " + plan.cases[1].id + " (n=2), " + plan.cases[3].id));
  const auto partial = plan::merge(plan, folder / "results", {.partial = true});
  EXPECT_EQ(partial.rows.size(), 3u);
  EXPECT_EQ(partial.missing, (std::vector{plan.cases[1].id, plan.cases[3].id}));
  run(folder, plan, program);
  fs::copy(plan::result_path(folder / "results", plan.cases[0].id), folder / "results" / "stranger.json");
  EXPECT_THAT(error_of([&] { merged(folder, plan); }),
              HasSubstr("a file that is not a result of plan spec: stranger.json"));
  EXPECT_EQ(plan::merge(plan, folder / "results", {.allow_foreign = true}).rows.size(), 5u);
  fs::rename(folder / "results" / "stranger.json", plan::result_path(folder / "results", plan.cases[1].id));
  EXPECT_THAT(error_of([&] { merged(folder, plan); }),
              HasSubstr(plan.cases[1].id + ".json: belongs to case " + plan.cases[0].id));
}

TEST(PlanMerge, AnotherProgramsResultsAreNeverMixedIn) {
  const Folder folder;
  const auto plan = plan_of(folder, kFive);
  const std::string program = script(folder);
  run(folder, plan, program, "results", {1, 2});
  plan::RunOptions other{.results = folder / "results", .program = executed(program), .program_hash = "q"};
  EXPECT_THAT(error_of([&] { plan::run(plan, other); }), HasSubstr("was made by another program, p"));
  EXPECT_EQ(runs(folder), 3u) << "before anything was run";
  other.shard = {2, 2};
  plan::run(plan, other);
  EXPECT_THAT(error_of([&] { merged(folder, plan); }), HasSubstr("was made by another program"));
  other.shard = {};
  other.replace_foreign = true;
  EXPECT_EQ(plan::run(plan, other).passed, 5u);
  EXPECT_EQ(plan::merge(plan, folder / "results", {}).program, "q");
}

TEST(PlanMerge, BooksOfCoverageAddUp) {
  const Folder folder;
  const auto plan = plan_of(folder, "kind = \"verify\"\n[axes]\nn = [1, 2, 4]\n");
  run(folder, plan, script(folder));
  const auto books = plan::merge(plan, folder / "results", {}).coverage;
  ASSERT_EQ(books.size(), 1u);
  EXPECT_EQ(books[0]["splats"], 7);
  EXPECT_EQ(books[0]["streams"], 3);
  EXPECT_EQ(books[0]["campaigns"]["all"]["a.b"], 7);
  EXPECT_EQ(books[0]["campaigns"]["all"]["only.2"], 1);
}

}  // namespace
}  // namespace fastsplat::plan_test
