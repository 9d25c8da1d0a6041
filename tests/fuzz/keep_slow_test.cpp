// SPDX-License-Identifier: Apache-2.0
// The results that `tools/fuzz --keep` keeps of a run, with scripts instead of fuzzers: hours add up only without
// findings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/paths.hpp"

namespace fastsplat::fuzz {
namespace {

namespace fs = std::filesystem;

class Keep : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "fastsplat-keep.XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    for (const char* part : {"root/tests/fuzz", "root/docs/evidence", "root/seeds", "root/tools", "build/bin"})
      fs::create_directories(folder_ / part);
    fs::copy(fs::path(FASTSPLAT_SOURCE_DIR) / "tools/helpers", folder_ / "root/tools/helpers");
    targets({"one", "two"});
  }
  void TearDown() override { fs::remove_all(folder_); }

  void targets(const std::vector<std::string>& names) {
    std::ofstream file(folder_ / "root/tests/fuzz/targets.def");
    for (const std::string& name : names) file << "FASTSPLAT_FUZZ_TARGET(" << name << ", \"seeds\", 1)\n";
  }
  /// The fuzzer of a target executes `what`.
  void fuzzer(const std::string& name, const std::string& what) {
    const fs::path path = folder_ / "build/bin" / ("fuzz_" + name);
    std::ofstream(path) << "#!/bin/sh\n" << what << '\n';
    fs::permissions(path, fs::perms::owner_all);
  }
  /// Output of tools/helpers/fuzz_targets, and its exit code.
  std::pair<std::string, int> run(const std::string& arguments) {
    const fs::path said = folder_ / "said.txt";
    const std::string root = (folder_ / "root").string(), build = (folder_ / "build").string();
    const int status = std::system(("'" + root + "/tools/helpers/fuzz_targets' '" + root + "' '" + build + "' " +
                                    arguments + " >'" + said.string() + "' 2>&1")
                                       .c_str());
    std::ifstream file(said);
    return {std::string(std::istreambuf_iterator<char>(file), {}), WEXITSTATUS(status)};
  }
  nlohmann::json kept() const {
    std::ifstream file(folder_ / "root/docs/evidence/fuzz.json");
    return file ? nlohmann::json::parse(file).at("targets") : nlohmann::json();
  }

  fs::path folder_;
};

/// libFuzzer's last line of a run without findings.
std::string fine(int runs, int edges) {
  return "echo '#1 NEW cov: " + std::to_string(edges) + " ft: 9'; echo 'Done " + std::to_string(runs) +
         " runs in 1 second(s)'";
}

TEST_F(Keep, RunsAddUpAndEdgesAreTheMost) {
  fuzzer("one", fine(300, 40));
  fuzzer("two", fine(5, 70));
  EXPECT_EQ(run("--keep --seconds 1").second, 0);
  fuzzer("one", fine(20, 30));
  const auto [said, code] = run("--keep --seconds 1 one");
  EXPECT_EQ(code, 0) << said;
  EXPECT_THAT(said, ::testing::HasSubstr("1 passed, 0 failed"));
  EXPECT_EQ(kept()["one"]["runs"], 320);
  EXPECT_EQ(kept()["one"]["edges"], 40);
  EXPECT_EQ(kept()["two"]["runs"], 5);
  std::printf("[figure] runs kept of 300 and 20 = %d\n", kept()["one"]["runs"].get<int>());
}

TEST_F(Keep, ProcessorTimeIsKeptNotTheClock) {
  fuzzer("one", "sleep 1.5; " + fine(1, 1));
  EXPECT_EQ(run("--keep one").second, 0);
  EXPECT_EQ(kept()["one"]["seconds"], 0);
  fuzzer("one", "timeout 3 sh -c 'while :; do :; done'; " + fine(1, 1));
  EXPECT_EQ(run("--keep one").second, 0);
  EXPECT_GE(kept()["one"]["seconds"], 1);
}

TEST_F(Keep, WithoutTheFlagNothingIs) {
  fuzzer("one", fine(3, 4));
  EXPECT_EQ(run("one").second, 0);
  EXPECT_TRUE(kept().is_null());
}

TEST_F(Keep, AFindingRestartsItsTargetUntilARunIsClean) {
  fuzzer("one", fine(300, 40));
  fuzzer("two", fine(5, 70));
  EXPECT_EQ(run("--keep").second, 0);
  fuzzer("one",
         "echo 'SUMMARY: AddressSanitizer: heap-buffer-overflow'; echo 'Test unit written to /an/input'; exit 77");
  const auto [said, code] = run("--keep");
  EXPECT_EQ(code, 1);
  EXPECT_THAT(said, ::testing::HasSubstr("FINDING: SUMMARY: AddressSanitizer: heap-buffer-overflow; input: /an/input"));
  EXPECT_EQ(kept()["one"]["runs"], 0);
  EXPECT_THAT(kept()["one"]["finding"].get<std::string>(), ::testing::HasSubstr("heap-buffer-overflow"));
  EXPECT_EQ(kept()["two"]["runs"], 10) << "the others keep theirs";
  fuzzer("one", fine(7, 8));
  EXPECT_EQ(run("--keep one").second, 0);
  EXPECT_EQ(kept()["one"]["runs"], 7);
  EXPECT_FALSE(kept()["one"].contains("finding"));
}

TEST_F(Keep, ARunThatTriedNothingIsAFinding) {
  fuzzer("one", fine(0, 0));
  EXPECT_EQ(run("--keep one").second, 1);
  EXPECT_TRUE(kept()["one"].contains("finding"));
}

TEST_F(Keep, AnInterruptedRunKeepsItsFindings) {
  fuzzer("one", fine(300, 40));
  EXPECT_EQ(run("--keep one").second, 0);
  fuzzer("one", "echo '==1== libFuzzer: run interrupted; exiting'; exit 72");
  const auto [said, code] = run("--keep one");
  EXPECT_EQ(code, 1);
  EXPECT_THAT(said, ::testing::HasSubstr("interrupted, not counted"));
  EXPECT_EQ(kept()["one"]["runs"], 300);
}

TEST_F(Keep, ATargetThatNeverRanHasNothingAndOneThatIsGoneIsForgotten) {
  fuzzer("one", fine(300, 40));
  EXPECT_EQ(run("--keep one").second, 0);
  EXPECT_EQ(kept()["two"]["runs"], 0);
  targets({"two"});
  fuzzer("two", fine(1, 1));
  EXPECT_EQ(run("--keep").second, 0);
  EXPECT_FALSE(kept().contains("one"));
}

}  // namespace
}  // namespace fastsplat::fuzz
