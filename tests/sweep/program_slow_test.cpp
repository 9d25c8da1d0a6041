// SPDX-License-Identifier: Apache-2.0
// Plans of the program itself: killed twice and resumed, verifications that add up, a failing case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

#include "analysis/sweep/plan.hpp"
#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
namespace fs = std::filesystem;

std::size_t results_in(const std::string& folder) {
  std::size_t count = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    count += entry.path().extension() == ".json" ? 1 : 0;
  return count;
}

std::string merged(const std::string& plan, const std::string& results) {
  const std::string out = results + ".merged";
  expect_success(fastsplat({"plan", "merge", plan, "--results", results, "-o", out}));
  return read_bytes(out);
}

constexpr const char* kLengths =
    "kind = [\"compare\", \"cycles\"]\n[constants]\nvolume = \"shells:16\"\nsize = 32\n"
    "[axes]\nsnap.phases = [16, 64]\nradial.entries = [64, 256, 1024]\n";

TEST(PlanProgram, KilledTwiceAndResumedGivesTheSameBytes) {
  const TempFolder folder;
  const std::string spec = folder.write("spec.toml", kLengths), plan = folder / "plan.json";
  expect_success(fastsplat({"plan", "make", spec, "-o", plan}));
  expect_success(fastsplat({"plan", "run", plan, "--results", folder / "whole", "--jobs", "2"}));
  const std::string killed = folder / "killed";
  std::size_t least = 1;
  for (const int signal : {SIGINT, SIGKILL}) {
    Surroundings stop;
    stop.signal = signal;
    stop.when = [&](pid_t) { return results_in(killed) >= least; };
    const auto result = fastsplat({"plan", "run", plan, "--results", killed, "--jobs", "1"}, stop);
    EXPECT_EQ(signal == SIGINT ? result.code : result.signal, signal == SIGINT ? 130 : SIGKILL);
    const std::size_t done = results_in(killed);
    std::printf("[figure] done_after_signal_%d = %zu (limit %zu..5)\n", signal, done, least);
    EXPECT_GE(done, least);
    EXPECT_LT(done, 6u) << "it was not stopped in the middle";
    least = done + 1;
  }
  const auto last = fastsplat({"plan", "run", plan, "--results", killed, "--json", "-"});
  expect_success(last);
  EXPECT_EQ(Json::parse(last.out)["skipped"], least - 1);
  EXPECT_TRUE(fs::is_empty(killed + "/.scratch")) << "what the killed ones left is cleared up";
  const std::string bytes = merged(plan, folder / "whole");
  EXPECT_TRUE(merged(plan, killed) == bytes);
  const Json all = Json::parse(bytes);
  EXPECT_EQ(all["rows"].size(), 6u);
  for (const auto& row : all["rows"]) {
    EXPECT_GT(row["metrics"]["psnr_db"].get<double>(), 40.0);
    EXPECT_GT(row["metrics"]["cost"].get<double>(), 0.0);
    EXPECT_GT(row["metrics"]["cycles"].get<double>(), 0.0);
  }
}

/// A plan, its undisturbed results, and the same results that disturbed runs must reach.
class PlanDisturbed : public ::testing::Test {
 protected:
  void SetUp() override {
    expect_success(fastsplat({"plan", "make", folder_.write("spec.toml", kLengths), "-o", plan_}));
    expect_success(fastsplat({"plan", "run", plan_, "--results", folder_ / "whole", "--jobs", "2"}));
    expected_ = merged(plan_, folder_ / "whole");
  }
  /// Results are complete and equal, or do not exist.
  void expect_sound(const std::string& results) const {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(results, ignored)) {
      if (entry.path().extension() != ".json") continue;
      EXPECT_EQ(read_bytes(entry.path()), read_bytes(folder_ / "whole/" + entry.path().filename().string()))
          << entry.path();
    }
  }
  /// The next, undisturbed run completes them.
  void expect_mended(const std::string& results) const {
    expect_success(fastsplat({"plan", "run", plan_, "--results", results, "--jobs", "2"}));
    EXPECT_TRUE(merged(plan_, results) == expected_) << results;
  }

  TempFolder folder_;
  std::string plan_ = folder_ / "plan.json", expected_;
};

TEST_F(PlanDisturbed, ByAFullDisk) {
  for (const int room : {4'096, 40'960, 98'304}) {
    const std::string place = folder_ / ("disk" + std::to_string(room)),
                      roomy = folder_ / ("roomy" + std::to_string(room));
    {
      const TinyDisk disk(place, room);
      if (!disk.mounted()) GTEST_SKIP() << disk.reason();
      const auto run = fastsplat({"plan", "run", plan_, "--results", place + "/results", "--jobs", "2"});
      const auto partial =
          fastsplat({"plan", "merge", plan_, "--results", place + "/results", "--partial", "-o", folder_ / "m.json"});
      std::printf("[figure] room = %d, exit code = %d, results = %zu\n", room, run.code,
                  results_in(place + "/results"));
      EXPECT_EQ(run.code, 3) << run.err;
      EXPECT_THAT(run.err, HasSubstr("No space left on device"));
      EXPECT_EQ(run.err.find("exe"), std::string::npos) << run.err;
      expect_sound(place + "/results");
      if (partial.code == 0) {
        EXPECT_EQ(read_bytes(folder_ / "m.json").find("No space"), std::string::npos);
      }
      fs::copy(place + "/results", roomy, fs::copy_options::recursive);
    }
    expect_mended(roomy);
  }
}

TEST_F(PlanDisturbed, ByALimitOnFiles) {
  std::size_t refused = 0;
  for (const rlim_t room : {100u, 3'000u, 10'000u}) {
    const std::string results = folder_ / ("limit" + std::to_string(room));
    Surroundings limited;
    limited.largest_file = room;
    const auto run = fastsplat({"plan", "run", plan_, "--results", results, "--jobs", "2"}, limited);
    std::printf("[figure] largest file = %lu, exit code = %d, results = %zu\n", static_cast<unsigned long>(room),
                run.code, results_in(results));
    refused += run.code == 3 ? 1 : 0;
    EXPECT_TRUE(run.code == 0 || run.code == 3) << run.err;
    expect_sound(results);
    expect_mended(results);
  }
  EXPECT_GE(refused, 2u);
}

TEST_F(PlanDisturbed, ByKillsAtAnyTime) {
  constexpr int kKills = 10;
  const auto seed = std::random_device()();
  std::mt19937 chance(seed);
  const std::string results = folder_ / "killed";
  std::size_t killed = 0, left = 0;
  const std::vector<std::string> command{"plan", "run", plan_, "--results", results, "--jobs", "2"};
  // Kills lie within the time of a whole run, however fast the machine is.
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_EQ(fastsplat(command).code, 0);
  const auto whole = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begun);
  for (int kill = 0; kill < kKills; ++kill) {
    if (results_in(results) == 6) fs::remove_all(results);
    const auto until = std::chrono::steady_clock::now() +
                       std::chrono::milliseconds(std::uniform_int_distribution<std::int64_t>(0, whole.count())(chance));
    Surroundings stop;
    stop.signal = SIGKILL;
    stop.when = [&](pid_t) { return std::chrono::steady_clock::now() >= until; };
    killed += fastsplat(command, stop).signal == SIGKILL ? 1 : 0;
    expect_sound(results);
    left += results_in(results);
  }
  std::printf("[figure] whole run = %lld ms, seed = %u, killed = %zu of %d (limit > 0), results left by them = %zu\n",
              static_cast<long long>(whole.count()), seed, killed, kKills, left);
  EXPECT_GT(killed, 0u);
  expect_mended(results);
}

TEST_F(PlanDisturbed, ByResultsThatAreEmptyOrCut) {
  const std::string results = folder_ / "whole";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(results))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  ASSERT_GE(files.size(), 2u);
  const std::string whole = read_bytes(files[1]);
  fs::resize_file(files[0], 0);
  fs::resize_file(files[1], whole.size() / 2);
  const auto refused = fastsplat({"plan", "merge", plan_, "--results", results, "-o", folder_ / "m.json"});
  EXPECT_EQ(refused.code, 3) << refused.err;
  expect_success(fastsplat({"plan", "merge", plan_, "--results", results, "-o", folder_ / "m.json", "--partial"}));
  const auto json = Json::parse(read_bytes(folder_ / "m.json"));
  EXPECT_EQ(json["missing"].size(), 2u);
  EXPECT_EQ(json["rows"].size(), 4u);
  expect_mended(results);
}

TEST_F(PlanDisturbed, NotByAMissingModule) {
  // The program without the module of OpenImageIO, copied away from it: a plan's pictures are EXR.
  fs::copy(program(), folder_ / "fastsplat");
  expect_success(run_words({folder_ / "fastsplat", "plan", "run", plan_, "--results", folder_ / "bare"}));
  EXPECT_EQ(results_in(folder_ / "bare"), 6u);
}

/// A foreign plan, with its hashes recomputed, runs nothing that plan make does not write.
TEST_F(PlanDisturbed, ByForgedSteps) {
  auto json = nlohmann::ordered_json::parse(read_bytes(plan_));
  json["cases"][0]["steps"][0]["argv"] = {"volume", "convert", "shells:8", folder_ / "stolen.nrrd"};
  const auto forged = folder_.write("forged.json", json.dump(1));
  expect_error(fastsplat({"plan", "run", forged}), 3, {"was changed"});
  EXPECT_FALSE(fs::exists(folder_ / "stolen.nrrd"));
}

/// The same with every hash computed again.
TEST(PlanProgram, AForgedStepIsAnErrorOfItsFile) {
  const TempFolder folder;
  plan::Plan plan;
  plan.axes = {{.name = "size", .values = {std::int64_t{8}}}};
  plan.cases = {{.id = {},
                 .axes = {{"size", std::int64_t{8}}},
                 .kind = "cycles",
                 .settings = {{"size", std::int64_t{8}}, {"volume", std::string("shells:8")}},
                 .content = {},
                 .steps = {{.words = {"volume", "convert", "shells:8", folder / "stolen.nrrd"}}}}};
  plan.cases[0].id = plan::id_of(plan.cases[0]);
  const auto forged = folder.write("forged.json", plan::to_json(plan).dump(1));
  expect_error(fastsplat({"plan", "run", forged}), 3, {"forged.json", "was not written by `fastsplat plan make`"});
  EXPECT_FALSE(fs::exists(folder / "stolen.nrrd"));
}

TEST(PlanProgram, ErrorsInASpecificationAreNamedCorrectly) {
  const TempFolder folder;
  const auto make = [&](const std::string& spec) {
    return fastsplat({"plan", "make", folder.write("s.toml", spec), "-o", folder / "p.json"});
  };
  expect_error(make("kind = \"cycls\"\n[axes]\nsize = [8]\n"), 3,
               {"s.toml: unknown kind 'cycls'", "did you mean 'cycles'?"});
  const auto bad = make("kind = \"cycles\"\n[constants]\nvolume = \"shells:8\"\n[axes]\nazimuth = [\"x\"]\n");
  expect_error(bad, 3, {"azimuth=x", "`fastsplat render --help` lists flags"});

  expect_success(
      make("kind = \"cycles\"\n[constants]\nvolume = \"shells:8\"\nconfig = \"tiny\"\n[axes]\nsize = [8]\n"
           "[[metrics]]\nname = \"nothing\"\npath = \"cycles/none\"\n"));
  expect_success(fastsplat({"plan", "run", folder / "p.json"}));
  const auto merge = fastsplat({"plan", "merge", folder / "p.json", "-o", folder / "m.json"});
  expect_success(merge);
  EXPECT_THAT(merge.err, HasSubstr("metric nothing: no result has a number at cycles/none"));
}

/// Cases whose volume is kept in memory, with the same splats or others, are as their commands
/// alone: all figures.
TEST(PlanProgram, CasesThatShareAVolumeAreAsTheirCommands) {
  const TempFolder folder;
  const std::string spec = folder.write("spec.toml", R"(
kind = "compare"
[constants]
volume = "shells:20"
size = 24
[axes]
counters = [false, true]
tf = ["default", "ct-head"]
shading = ["on", "off"]
azimuth = [0, 30, 60]
)");
  const std::string plan = folder / "plan.json";
  expect_success(fastsplat({"plan", "make", spec, "-o", plan}));
  expect_success(fastsplat({"plan", "run", plan, "--jobs", "2"}));
  Surroundings here;
  here.folder = folder.path();
  here.environment = {"PATH=" + fs::path(program()).parent_path().string() + ":" + std::getenv("PATH")};
  std::size_t compared = 0;
  const Json all = Json::parse(merged(plan, folder / "plan.results"));
  for (const auto& row : all["rows"]) {
    const bool counted = row["command"].get<std::string>().find(" --counters ") != std::string::npos;
    EXPECT_EQ(row["metrics"].contains("sheet_saturated"), counted) << row["command"];
    const auto again = run_words({"sh", "-c", row["command"].get<std::string>() + " --json again.json"}, here);
    expect_success(again);
    const auto json = Json::parse(read_bytes(folder / "again.json"));
    for (const char* figure : {"psnr_db", "max_abs_lsb", "rmse_lsb", "mean_abs_lsb", "bias_lsb", "ssim"}) {
      EXPECT_EQ(json[figure], row["metrics"][figure]) << row["command"];
      ++compared;
    }
  }
  std::printf("[figure] figures compared = %zu (limit 144)\n", compared);
  EXPECT_EQ(compared, 144u);
}

/// A volume that is written over while the plan runs gives no result under the content that the plan names.
TEST(PlanProgram, AVolumeThatChangesMeanwhileGivesNoResult) {
  const TempFolder folder;
  const std::string volume = folder / "v.nrrd", plan = folder / "plan.json", results = folder / "plan.results";
  expect_success(fastsplat({"volume", "convert", "shells:16", volume}));
  const std::string whole = read_bytes(volume);
  const std::string spec =
      folder.write("spec.toml",
                   "kind = \"compare\"\n[constants]\nvolume = \"v.nrrd\"\nsize = 24\n[axes]\nazimuth = [0, 10, 20]\n"
                   "sheet.frac_bits = [8, 9, 10, 11, 12, 13, 14, 15]\n");
  expect_success(fastsplat({"plan", "make", spec, "-o", plan}));
  expect_success(fastsplat({"plan", "run", plan, "--results", folder / "undisturbed"}));
  Surroundings meddling;
  bool changed = false;
  meddling.when = [&](pid_t) {
    if (!changed && results_in(results) >= 2) {
      folder.write("v.nrrd", whole.substr(0, whole.size() / 2));
      changed = true;
    }
    return false;
  };
  meddling.signal = SIGUSR1;  // never sent
  const auto run = fastsplat({"plan", "run", plan, "--jobs", "1"}, meddling);
  const std::size_t before = results_in(results);
  std::printf("[figure] results of 24 before the volume changed = %zu (limit 2..23)\n", before);
  EXPECT_TRUE(changed);
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_THAT(run.err, HasSubstr("v.nrrd: changed while the plan ran"));
  EXPECT_LT(before, 24u);
  folder.write("v.nrrd", whole);
  expect_success(fastsplat({"plan", "run", plan, "--jobs", "2"}));
  EXPECT_EQ(merged(plan, results), merged(plan, folder / "undisturbed"));
}

TEST(PlanProgram, ARowsCommandMakesItAgain) {
  const TempFolder folder;
  const std::string spec = folder.write(
                        "spec.toml",
                        "kind = \"compare\"\n[constants]\nvolume = \"shells:8\"\nsize = 16\nmin-psnr = 90\n"
                        "[axes]\ncolour.frac_bits = [16]\n"),
                    plan = folder / "plan.json";
  expect_success(fastsplat({"plan", "make", spec, "-o", plan}));
  EXPECT_EQ(fastsplat({"plan", "run", plan}).code, 1) << "its limit is broken";
  const auto row = Json::parse(merged(plan, folder / "plan.results"))["rows"][0];
  EXPECT_EQ(row["status"], "fail");
  EXPECT_THAT(row["message"].get<std::string>(), HasSubstr("limit 90"));
  Surroundings here;
  here.folder = folder.path();
  here.environment = {"PATH=" + fs::path(program()).parent_path().string() + ":" + std::getenv("PATH")};
  const auto again = run_words({"sh", "-c", row["command"].get<std::string>() + " --json again.json"}, here);
  EXPECT_EQ(again.code, 1) << again.err;
  const auto json = Json::parse(read_bytes(folder / "again.json"));
  EXPECT_EQ(json["psnr_db"], row["metrics"]["psnr_db"]);
}

TEST(PlanProgram, BooksOfVerifyAddUpToOneCampaigns) {
  const TempFolder folder;
  const std::string spec = folder.write("spec.toml",
                                        "kind = \"verify\"\n[constants]\nconfig = \"tiny\"\nrandom = 60\n"
                                        "[axes]\nseed = {from = 1, to = 3}\n"),
                    plan = folder / "plan.json", book = folder / "book.json";
  expect_success(fastsplat({"plan", "make", spec, "-o", plan}));
  expect_success(fastsplat({"plan", "run", plan}));
  expect_success(fastsplat({"verify", "--config", "tiny", "--random", "60", "--seeds", "3", "--coverage", book}));
  const auto sum = Json::parse(merged(plan, folder / "plan.results"))["coverage"]["books"];
  ASSERT_EQ(sum.size(), 1u);
  EXPECT_EQ(sum[0], Json::parse(read_bytes(book)));
  std::printf("[figure] splats = %d (limit > 0)\n", sum[0]["splats"].get<int>());
  EXPECT_GT(sum[0]["splats"].get<int>(), 0);
}

TEST(PlanProgram, ExamplesExpandAndEditedFilesAreSeen) {
  std::size_t examples = 0;
  for (const auto& entry : fs::directory_iterator(FASTSPLAT_SOURCE_DIR "/configs/plans")) {
    const auto result = fastsplat({"plan", "make", entry.path().string(), "--json", "-"});
    if (result.code == 3 && result.err.find("mricron-data") != std::string::npos) continue;
    expect_success(result);
    ++examples;
  }
  std::printf("[figure] examples = %zu (limit > 0)\n", examples);
  EXPECT_GT(examples, 0u);

  const TempFolder folder;
  const std::string mine = folder.write("mine.toml", fastsplat({"config", "show", "small"}).out),
                    plan = folder / "plan.json",
                    spec = folder.write("spec.toml",
                                        "kind = \"cycles\"\n[constants]\nvolume = \"shells:8\"\nsize = 16\n"
                                        "[axes]\nconfig = [\"mine.toml\", \"base\"]\n");
  expect_success(fastsplat({"plan", "make", spec, "-o", plan}));
  expect_success(fastsplat({"plan", "run", plan}));
  folder.write("mine.toml", fastsplat({"config", "show", "small", "--set", "radial.entries=64"}).out);
  expect_error(fastsplat({"plan", "make", spec, "-o", mine}), 2, {"mine.toml", "an input and an output"});
  expect_error(fastsplat({"plan", "merge", plan, "-o", folder / "plan.results/m.json"}), 2, {"folder of results"});
  const auto result = fastsplat({"plan", "run", plan});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err, HasSubstr("changed after the plan was made"));
}

}  // namespace
}  // namespace fastsplat::cli_test
