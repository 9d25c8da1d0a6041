// Plans of the program itself: killed twice and resumed, verifications that add up, a case that fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

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
  EXPECT_EQ(Json::parse(bytes)["rows"].size(), 6u);
  for (const auto& row : Json::parse(bytes)["rows"]) {
    EXPECT_GT(row["metrics"]["psnr_db"].get<double>(), 40.0);
    EXPECT_GT(row["metrics"]["cost"].get<double>(), 0.0);
    EXPECT_GT(row["metrics"]["cycles"].get<double>(), 0.0);
  }
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
  expect_error(fastsplat({"plan", "make", spec, "-o", mine}), 2, {"mine.toml", "it is read"});
  expect_error(fastsplat({"plan", "merge", plan, "-o", folder / "plan.results/m.json"}), 2, {"among the results"});
  const auto result = fastsplat({"plan", "run", plan});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err, HasSubstr("is not what the plan was made of"));
}

}  // namespace
}  // namespace fastsplat::cli_test
