// The cluster that the tests bring up is a real one: what its users rely on, with the smallest of tasks.
#include <gtest/gtest.h>

#include "tests/slurm/cluster_helper.hpp"

namespace fastsplat::slurm_test {
namespace {

TEST(Cluster, RequeuesATaskWhoseNodeWentAwayAndLeavesNothing) {
  if (const auto why = why_no_cluster(); !why.empty()) GTEST_SKIP() << why;
  Cluster cluster(2);
  const auto& folder = cluster.folder();
  folder.write("task.sh",
               "#!/bin/sh\n"
               "echo \"$SLURMD_NODENAME ${SLURM_RESTART_COUNT:-0}\" >>at.$SLURM_ARRAY_TASK_ID\n"
               "[ \"${SLURM_RESTART_COUNT:-0}\" = 1 ] || [ $SLURM_ARRAY_TASK_ID = 0 ] || sleep 60\n");
  const auto id = cluster.say({"sbatch", "--parsable", "--array=0-1", "--requeue", "task.sh"});
  const auto log = folder.path() / "at.1";
  ASSERT_TRUE(wait_until([&] { return !cli_test::read_bytes(log).empty(); }, 20)) << cluster.logs();
  const auto node = cli_test::read_bytes(log).substr(0, 2);
  cluster.crash(node);
  EXPECT_TRUE(cluster.node_state(node).starts_with("down")) << cluster.node_state(node);
  cluster.bring_back(node);
  ASSERT_TRUE(wait_until([&] { return cluster.ended(id); }, 30)) << cluster.logs();
  for (const auto& job : cluster.jobs(id)) EXPECT_EQ(job.at("JobState"), "COMPLETED") << job.at("JobId");
  EXPECT_NE(cli_test::read_bytes(log).find(" 1\n"), std::string::npos) << cli_test::read_bytes(log);
  EXPECT_EQ(cluster.end(), std::vector<std::string>{});
}

}  // namespace
}  // namespace fastsplat::slurm_test
