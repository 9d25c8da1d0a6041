// SPDX-License-Identifier: Apache-2.0
// plan submit without a cluster: its errors, cancelled halves of a submission, dry runs, and GNU parallel as an engine.
#include <gtest/gtest.h>

#include "tests/slurm/small_plan_helper.hpp"

namespace fastsplat::slurm_test {
namespace {

using cli_test::expect_error;
using cli_test::read_bytes;
using testing::HasSubstr;

class Submit : public testing::Test {
 protected:
  /// A stub of a client, found before any real one.
  void stand_in(const std::string& client, const std::string& script) {
    std::filesystem::create_directories(folder_.path() / "bin");
    folder_.write("bin/" + client, "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder_ / ("bin/" + client), std::filesystem::perms::owner_all);
  }
  std::vector<std::string> with_stand_ins() const { return {"PATH=" + (folder_ / "bin") + ":" + std::getenv("PATH")}; }

  cli_test::TempFolder folder_;
  SmallPlan plan_{folder_, 3};
};

TEST_F(Submit, ErrorsAreOneLineAndLeaveNothing) {
  const std::vector<std::string> slurm{"plan", "submit", "plan.json", "--engine", "slurm"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_error(plan_.run(slurm, {"PATH=/nowhere"}), 3, {"sbatch is not installed", "--engine script"});
  expect_error(plan_.run({"plan", "submit", "plan.json"}), 2, {"--engine", "slurm or script"});
  expect_error(plan_.run(with(slurm, {"--time", "soon"})), 2, {"--time", "soon"});
  expect_error(plan_.run(with(slurm, {"--sbatch=account=x"})), 2, {"--sbatch", "account=x"});
  expect_error(plan_.run(with(slurm, {"--partition", "a b"})), 2, {"--partition", "a b"});
  expect_error(plan_.run({"plan", "submit", "spec.toml", "--engine", "script"}), 3, {"spec.toml"});
  // A folder that not even root can create.
  expect_error(plan_.run({"plan", "submit", "plan.json", "--engine", "script", "--results", "plan.json/x"}), 3,
               {"plan.json/x", "Not a directory"});
  stand_in("sbatch", "exit 0\n");
  stand_in("scontrol", "echo 'scontrol: error: Unable to contact slurm controller (connect failure)' >&2; exit 1\n");
  stand_in("squeue", "exit 1\n");
  stand_in("scancel", "exit 0\n");
  expect_error(plan_.run(slurm, with_stand_ins()), 3, {"Unable to contact", "--array-max"});
  EXPECT_FALSE(std::filesystem::exists(plan_ / "plan.results"));
}

TEST_F(Submit, JobsQueuedBeforeARefusalAreCancelled) {
  stand_in("scontrol", "echo 'MaxArraySize            = 1'\n");
  stand_in("squeue", "");
  // The third array is one too many.
  stand_in("sbatch",
           "echo \"$@\" >>sent\n"
           "case \"$*\" in *array-3*) echo 'sbatch: error: Batch job submission failed: Job violates policy' >&2; exit "
           "1 ;; esac\n"
           "wc -l <sent\n");
  stand_in("scancel", "echo \"$@\" >>taken_back\n");
  expect_error(plan_.run({"plan", "submit", "plan.json", "--engine", "slurm"}, with_stand_ins()), 3,
               {"sbatch: ", "Job violates policy", "nothing was queued"});
  const auto sent = read_bytes(plan_ / "sent");
  EXPECT_THAT(sent, HasSubstr("--parsable --array=0 /"));
  EXPECT_THAT(sent, HasSubstr("array-2"));
  EXPECT_EQ(read_bytes(plan_ / "taken_back"), "1 2\n");
}

TEST_F(Submit, ADryRunShowsScriptsAndCommandsAndWritesNothing) {
  const auto before = std::distance(std::filesystem::directory_iterator(plan_.folder()), {});
  const auto shown = plan_.succeed({"plan", "submit", "plan.json", "--engine", "slurm", "--dry-run", "--array-max", "2",
                                    "--shards", "3", "--partition", "short", "--time", "2-0"},
                                   {"PATH=/nowhere"});
  for (const char* text : {"3 of 3 cases to do, in 3 of 3 tasks", "#SBATCH --partition=\"short\"", "#SBATCH --time=2-0",
                           "sbatch --parsable --array=0-1 ", "sbatch --parsable --array=0 ",
                           "sbatch --parsable --dependency=afterany:JOB1:JOB2 "})
    EXPECT_THAT(shown.out, HasSubstr(text));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(plan_.folder()), {}), before);
}

TEST_F(Submit, GnuParallelRunsTheCommandListToTheSameBytes) {
  if (cli_test::run_words({"sh", "-c", "command -v parallel"}).code != 0)
    GTEST_SKIP() << "no GNU parallel here: apt-get install parallel";
  const std::string here = plan_.run_here("here");
  plan_.copy_without("here", "there", 1, 3);
  plan_.succeed({"plan", "submit", "plan.json", "--engine", "script", "--results", "there", "--shards", "3"});
  // The subcommand's printed command, in a shell elsewhere; GNU parallel counts a task with a failed case as one.
  cli_test::Surroundings elsewhere;
  elsewhere.folder = "/";
  elsewhere.environment = {"HOME=" + folder_.path().string()};
  const auto submit = plan_.folder() / "there" / "submit";
  const auto ran = cli_test::run_words(
      {"sh", "-c", "parallel --jobs 2 <\"$1\"/commands.txt; sh \"$1\"/merge.sh", "sh", submit.string()}, elsewhere);
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto list = read_bytes(submit / "commands.txt");
  figure("commands", static_cast<double>(std::count(list.begin(), list.end(), '\n')),
         "1: of three shards two are done");
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 1);
  EXPECT_EQ(read_bytes(plan_ / "plan.merged.json"), here);
}

}  // namespace
}  // namespace fastsplat::slurm_test
