// SPDX-License-Identifier: Apache-2.0
// Arrays and scripts of a plan: chunks, ranges, words that survive a shell; the shell itself runs the scripts.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "analysis/sweep/script_engines.hpp"
#include "analysis/sweep/slurm_script.hpp"
#include "base/error.hpp"
#include "base/shell_word.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::plan {
namespace {

using cli_test::read_bytes;
using cli_test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// All of `shards` unfinished, arrays of `array_max`.
Submission submission(std::size_t shards, std::size_t array_max) {
  Submission s{.name = "fs-bits-01234567",
               .what = "plan bits, 10 cases",
               .program = "/opt/fastsplat",
               .plan = "/data/plan.json",
               .results = "/data/results",
               .merged = "/data/merged.json",
               .folder = "/data",
               .shards = shards,
               .to_do = std::vector<std::size_t>(shards),
               .array_max = array_max};
  std::iota(s.to_do.begin(), s.to_do.end(), std::size_t{1});
  return s;
}

TEST(JobArrays, EveryShardIsOneTaskOfOneArrayWhateverTheLimit) {
  int compared = 0;
  for (const std::size_t shards : {1u, 2u, 9u, 10u, 11u, 1000u, 1001u}) {
    for (const std::size_t most : {1u, 2u, 10u, 1001u}) {
      std::vector<std::size_t> seen;
      for (const auto& array : arrays_of(submission(shards, most))) {
        EXPECT_LE(array.length, most);
        for (const std::size_t task : array.tasks) {
          EXPECT_LT(task, array.length);
          seen.push_back(array.first + task);
        }
      }
      EXPECT_EQ(seen, submission(shards, most).to_do) << shards << " in arrays of " << most;
      ++compared;
    }
  }
  std::printf("[figure] divisions = %d (limit 28)\n", compared);
  EXPECT_EQ(compared, 28);
}

TEST(JobArrays, FinishedCasesAreNotSentAndNumbersStay) {
  auto s = submission(10, 4);
  s.to_do = {2, 3, 10};
  const auto arrays = arrays_of(s);
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_EQ(arrays[0].number, 1u);
  EXPECT_THAT(arrays[0].tasks, ElementsAre(1, 2));
  EXPECT_EQ(arrays[1].number, 3u);  // the second array is done
  EXPECT_EQ(arrays[1].first, 9u);
  EXPECT_EQ(arrays[1].length, 2u);
  EXPECT_THAT(arrays[1].tasks, ElementsAre(1));
  EXPECT_EQ(log_stem(s, 10), "array-3_1.");
}

TEST(JobArrays, RangesAreShort) {
  EXPECT_EQ(index_ranges({0}), "0");
  EXPECT_EQ(index_ranges({0, 1}), "0-1");
  EXPECT_EQ(index_ranges({0, 1, 2, 5, 7, 8}), "0-2,5,7-8");
}

TEST(JobArrays, NamesOfJobsDifferByPlanAndFolder) {
  const auto name = job_name("7 bits: head/ü", "0123", "/data/results");
  EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_';
  })) << name;
  EXPECT_EQ(name, job_name("7 bits: head/ü", "0123", "/data/results"));
  EXPECT_NE(name, job_name("7 bits: head/ü", "0124", "/data/results"));
  EXPECT_NE(name, job_name("7 bits: head/ü", "0123", "/data/other"));
}

TEST(SlurmScript, PrintsTheSlurmScript) {
  auto s = submission(2500, 1001);
  s.partition = "long";
  s.time = "1:30:00";
  s.jobs = 4;
  s.at_once = 50;
  s.directives = {"--account=chips"};
  const auto arrays = arrays_of(s);
  ASSERT_EQ(arrays.size(), 3u);
  const auto script = slurm_array_script(s, arrays[1]);
  for (const char* line :
       {"#SBATCH --partition=\"long\"\n", "#SBATCH --time=1:30:00\n", "#SBATCH --cpus-per-task=4\n",
        "#SBATCH --account=chips\n", "#SBATCH --requeue\n", "#SBATCH --open-mode=append\n",
        "--shard $((SLURM_ARRAY_TASK_ID + 1002))/2500 --results /data/results --jobs 4 --threads 1 "})
    EXPECT_THAT(script, HasSubstr(line));
  EXPECT_THAT(sbatch_array(s, arrays[2]),
              ElementsAre("sbatch", "--parsable", "--array=0-497%50", "/data/results/submit/array-3.sbatch"));
  EXPECT_THAT(sbatch_merge(s, {"7", "9"}),
              ElementsAre("sbatch", "--parsable", "--dependency=afterany:7:9", "/data/results/submit/merge.sbatch"));
  EXPECT_THAT(sbatch_merge(s, {}), ElementsAre("sbatch", "--parsable", "/data/results/submit/merge.sbatch"));
  // A directive after the first command has no effect.
  EXPECT_LT(script.rfind("#SBATCH"), script.find("\nfor "));
}

TEST(ScriptEngines, LsfAndSgeGetTheSameRequests) {
  auto s = submission(1500, 1000);
  s.partition = "long";
  s.time = "90:30";  // minutes and seconds
  s.at_once = 8;
  const auto files = engine_scripts(s);
  ASSERT_EQ(files.size(), 4u);
  for (const char* line :
       {"#BSUB -J \"fs-bits-01234567-2[1-500]%8\"\n", "#$ -t 1-500\n", "#$ -tc 8\n", "#BSUB -q long\n", "#$ -q long\n",
        "#BSUB -W 1:31\n", "#$ -l h_rt=1:30:30\n", "--shard $((task + 1000))/1500"})
    EXPECT_THAT(files[1].text, HasSubstr(line));
  const auto recipes = engine_recipes(s);
  EXPECT_THAT(recipes, HasSubstr("bsub -w \"ended(fs-bits-01234567-1) && ended(fs-bits-01234567-2)\" < "));
  EXPECT_THAT(recipes, HasSubstr("qsub -hold_jid fs-bits-01234567-1,fs-bits-01234567-2 "));
}

TEST(Durations, AsSbatchReadsThem) {
  EXPECT_EQ(seconds_from("90"), 90 * 60);
  EXPECT_EQ(seconds_from("90:30"), 90 * 60 + 30);
  EXPECT_EQ(seconds_from("1:30:05"), 5405);
  EXPECT_EQ(seconds_from("2-12"), 60 * 3600);
  EXPECT_EQ(seconds_from("2-12:30"), 60 * 3600 + 1800);
  EXPECT_EQ(seconds_from("2-12:30:10"), 60 * 3600 + 1810);
  for (const char* bad : {"", "0", "x", "1h", "-1", "1:2:3:4", "1-", "2 "})
    EXPECT_THROW(seconds_from(bad), UserError) << bad;
}

/// Scripts for a stub of the program, in folders whose names need every kind of quoting.
class Scripts : public testing::Test {
 protected:
  Scripts() {
    namespace fs = std::filesystem;
    const auto work = outer_.path() / "a b'c\"d%1$x#";
    s_.folder = work;
    s_.results = work / "results";
    s_.plan = work / "plan.json";
    s_.merged = work / "merged.json";
    s_.program = work / "program";
    fs::create_directories(s_.logs());
    write_file("plan.json", "{}");
    write_file("program", "#!/bin/sh\nfor word; do echo \"$word\" >>said; done\n[ $2 != merge ] || exit ${MERGE:-0}\n");
    fs::permissions(s_.program, fs::perms::owner_all);
  }
  void write_file(const std::string& name, const std::string& text) const {
    std::ofstream(s_.folder / name, std::ios::binary) << text;
  }
  /// The arguments that the stub was called with, one a line; reading clears them.
  std::string said() const {
    const auto text = read_bytes(s_.folder / "said");
    std::filesystem::remove(s_.folder / "said");
    return text;
  }
  cli_test::Result shell(const std::string& script, std::vector<std::string> environment) {
    cli_test::Surroundings elsewhere;
    elsewhere.folder = "/";
    elsewhere.environment = std::move(environment);
    return cli_test::run_words({"sh", outer_.write("script.sh", script)}, elsewhere);
  }
  std::string task_words(int shard) const {
    return "plan\nrun\n" + s_.plan.string() + "\n--shard\n" + std::to_string(shard) + "/20\n--results\n" +
           s_.results.string() + "\n--jobs\n1\n--threads\n1\n--quiet\n";
  }

  TempFolder outer_;
  Submission s_ = submission(20, 8);
};

TEST_F(Scripts, ATaskRunsItsShardInTheFolderOfTheCommand) {
  const auto arrays = arrays_of(s_);
  ASSERT_EQ(arrays.size(), 3u);
  const auto ran = shell(slurm_array_script(s_, arrays[2]), {"SLURM_ARRAY_TASK_ID=3"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(said(), task_words(20));
  const auto files = engine_scripts(s_);
  for (const char* task : {"LSB_JOBINDEX=4", "SGE_TASK_ID=4"}) {
    EXPECT_EQ(shell(files[1].text, {task}).code, 0);
    EXPECT_EQ(said(), task_words(12)) << task;
    EXPECT_TRUE(std::filesystem::remove(s_.logs() / (log_stem(s_, 12) + "log")))
        << "--lost names another log, " << task;
  }
  for (const char* none : {"LSB_JOBINDEX=0", "SGE_TASK_ID=undefined", "NOTHING=1"}) {
    const auto refused = shell(files[1].text, {none});
    EXPECT_EQ(refused.code, 2) << none;
    EXPECT_THAT(refused.err, HasSubstr("bsub or qsub"));
  }
}

TEST_F(Scripts, TheCommandListNamesThePendingCases) {
  s_.to_do = {3, 5};
  const auto list = engine_scripts(s_).back().text;
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 2);
  EXPECT_EQ(shell(list, {}).code, 0);
  EXPECT_EQ(said(), task_words(3) + task_words(5));
}

TEST_F(Scripts, AMachineThatDoesNotSeeTheFoldersSaysSo) {
  std::filesystem::remove(s_.plan);
  const auto ran = shell(slurm_array_script(s_, arrays_of(s_)[0]), {"SLURM_ARRAY_TASK_ID=3"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("cannot read " + s_.plan.string()));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_EQ(said(), "");
}

TEST_F(Scripts, TheMergeNamesLostCasesAndKeepsItsExitCode) {
  for (const int code : {0, 1, 3}) {
    const auto ran = shell(slurm_merge_script(s_), {"MERGE=" + std::to_string(code)});
    EXPECT_EQ(ran.code, code);
    const auto words = said();
    EXPECT_THAT(words, HasSubstr("plan\nmerge\n" + s_.plan.string() + "\n--results\n" + s_.results.string() + "\n-o\n" +
                                 s_.merged.string() + "\n"));
    // A case that failed is a result: nothing is lost.
    EXPECT_EQ(words.find("--lost") != std::string::npos, code == 3) << words;
  }
}

}  // namespace
}  // namespace fastsplat::plan
