// SPDX-License-Identifier: Apache-2.0
// A plan on a real cluster: two nodes, one of which fails in the middle of its work. The merged result equals that of a
// local run byte for byte, and no process remains.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/slurm/cluster_helper.hpp"
#include "tests/slurm/small_plan_helper.hpp"

namespace fastsplat::slurm_test {
namespace {

using cli_test::read_bytes;
using nlohmann::json;
using testing::HasSubstr;

constexpr int kShards = 3;
constexpr double kLongest = 150.0;  ///< seconds for ten seconds of work on an idle machine

std::vector<std::string> submission(const std::string& results, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"plan",
                                 "submit",
                                 "plan.json",
                                 "--engine",
                                 "slurm",
                                 "--results",
                                 results,
                                 "--shards",
                                 std::to_string(kShards),
                                 "-o",
                                 results + ".merged.json",
                                 "--json",
                                 "-"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Time and inode of a file: a result that was made again has others.
std::pair<ino_t, std::filesystem::file_time_type> identity(const std::filesystem::path& file) {
  struct stat status {};
  ::stat(file.c_str(), &status);
  return {status.st_ino, std::filesystem::last_write_time(file)};
}

/// The output of all jobs of a submission.
std::string logs_of(const std::filesystem::path& results) {
  std::string text;
  for (const auto& entry : std::filesystem::directory_iterator(results / "submit" / "log"))
    text += "--- " + entry.path().filename().string() + "\n" + read_bytes(entry.path());
  return text;
}

class PlanOnACluster : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = why_no_cluster(); !why.empty()) GTEST_SKIP() << why;
    // An array has two tasks at most here: three shards are two arrays.
    cluster_ = std::make_unique<Cluster>(2, 2);
    plan_ = std::make_unique<SmallPlan>(cluster_->folder(), 8);
  }

  json submit(const std::vector<std::string>& words) const {
    const auto sent = plan_->succeed(words, cluster_->environment());
    return sent.code == 0 ? json::parse(sent.out) : json();
  }
  std::string state(const std::string& job) const {
    const auto jobs = cluster_->jobs(job);
    return jobs.size() == 1 ? jobs[0].at("JobState") : "unknown";
  }
  [[nodiscard]] bool ends(const std::string& job) const {
    return wait_until([&] { return cluster_->ended(job); }, kLongest);
  }

  std::unique_ptr<Cluster> cluster_;
  std::unique_ptr<SmallPlan> plan_;
};

/// The shard of a task that runs, has results and has unfinished cases; 0 for none.
int shard_in_the_midst(const SmallPlan& plan, const std::vector<Job>& tasks, Job& which) {
  for (const auto& task : tasks) {
    if (task.at("JobState") != "RUNNING" || !task.contains("ArrayTaskId")) continue;
    const int shard = std::stoi(task.at("ArrayTaskId")) + 1;  // of the first array
    const auto done = plan.done_of("cluster", shard, kShards).size();
    if (done == 0 || done >= plan.files_of("cluster", shard, kShards).size()) continue;
    which = task;
    return shard;
  }
  return 0;
}

TEST_F(PlanOnACluster, ANodeGoesAwayAndATaskIsLostAndTheResultIsTheSame) {
  const std::string here = plan_->run_here("here");
  figure("failed_rows", rows_with(here, "fail"), "1");
  ASSERT_EQ(rows_with(here, "fail"), 1);
  ASSERT_EQ(rows_with(here, "pass"), 7);

  // --- a node fails
  const json sent = submit(submission("cluster"));
  ASSERT_TRUE(sent.is_object()) << cluster_->logs();
  ASSERT_EQ(sent.at("arrays").size(), 2u) << sent.dump(1);
  EXPECT_EQ(sent.at("array_max"), 2);
  const std::string first = sent.at("arrays")[0].at("job"), second = sent.at("arrays")[1].at("job");
  const std::string merge = sent.at("merge_job");
  Job victim;
  int shard = 0;
  ASSERT_TRUE(
      wait_until([&] { return (shard = shard_in_the_midst(*plan_, cluster_->jobs(first), victim)) != 0; }, kLongest))
      << cluster_->logs();
  const auto node = victim.at("NodeList");
  cluster_->crash(node);
  EXPECT_TRUE(cluster_->node_state(node).starts_with("down")) << cluster_->node_state(node);
  const auto kept = plan_->done_of("cluster", shard, kShards);
  ASSERT_LT(kept.size(), plan_->files_of("cluster", shard, kShards).size()) << "it was done before the node went";
  std::vector<std::pair<ino_t, std::filesystem::file_time_type>> before;
  for (const auto& file : kept) before.push_back(identity(file));
  cluster_->bring_back(node);

  ASSERT_TRUE(ends(merge)) << cluster_->logs();
  EXPECT_EQ(state(merge), "COMPLETED") << logs_of(*plan_ / "cluster");
  const std::string merged = read_bytes(*plan_ / "cluster.merged.json");
  figure("merged_bytes", static_cast<double>(merged.size()), "as here: " + std::to_string(here.size()));
  EXPECT_EQ(merged, here);
  // The task ran twice and continued where it had stopped.
  int restarts = 0, failed_tasks = 0;
  for (const auto& id : {first, second}) {
    for (const auto& task : cluster_->jobs(id)) {
      restarts += std::stoi(task.at("Restarts"));
      failed_tasks += task.at("JobState") == "FAILED" && task.at("ExitCode") == "1:0" ? 1 : 0;
    }
  }
  figure("requeued_tasks", restarts, "1");
  EXPECT_EQ(restarts, 1);
  figure("tasks_with_a_failed_case", failed_tasks, "1");
  EXPECT_EQ(failed_tasks, 1);
  figure("results_kept_over_the_crash", static_cast<double>(kept.size()), "> 0");
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(identity(kept[i]), before[i]) << kept[i];

  // --- a task is lost: its missing cases are named, and submitted again alone
  plan_->copy_without("cluster", "lost", 2, kShards);
  const json held = submit(submission("lost", {"--sbatch=--hold"}));
  ASSERT_EQ(held.at("arrays").size(), 1u) << held.dump(1);
  EXPECT_EQ(held.at("arrays")[0].at("tasks"), "1");  // of shards 1 and 2 only the second
  const std::string array = held.at("arrays")[0].at("job");
  cli_test::expect_error(
      [&] {
        auto again = submission("lost");
        again.resize(again.size() - 2);  // as text
        return plan_->run(again, cluster_->environment());
      }(),
      3, {"queued", array});
  cluster_->say({"scontrol", "release", held.at("merge_job")});
  cluster_->say({"scancel", array});
  ASSERT_TRUE(ends(held.at("merge_job"))) << cluster_->logs();
  EXPECT_EQ(state(held.at("merge_job")), "FAILED");
  EXPECT_FALSE(std::filesystem::exists(*plan_ / "lost.merged.json"));
  const auto said = logs_of(*plan_ / "lost");
  EXPECT_THAT(said, HasSubstr("shard 2 of 3 has no result for 3 cases"));
  for (const auto& file : plan_->files_of("lost", 2, kShards)) EXPECT_THAT(said, HasSubstr(file.stem().string()));

  const json again = submit(submission("lost"));
  ASSERT_EQ(again.at("arrays").size(), 1u);
  EXPECT_EQ(again.at("arrays")[0].at("tasks"), "1");
  ASSERT_TRUE(ends(again.at("merge_job"))) << cluster_->logs();
  EXPECT_EQ(read_bytes(*plan_ / "lost.merged.json"), here) << logs_of(*plan_ / "lost");

  // --- a refusal by sbatch leaves no job in the queue
  plan_->copy_without("cluster", "refused", 2, kShards);
  auto refused = submission("refused", {"--partition", "nowhere"});
  std::erase(refused, "--json");
  std::erase(refused, "-");
  cli_test::expect_error(plan_->run(refused, cluster_->environment()), 3, {"sbatch", "nvalid partition"});
  EXPECT_EQ(cluster_->say({"squeue", "-h"}), "");

  const auto left = cluster_->end();
  figure("processes_left", static_cast<double>(left.size()), "0");
  EXPECT_THAT(left, testing::IsEmpty());
}

}  // namespace
}  // namespace fastsplat::slurm_test
