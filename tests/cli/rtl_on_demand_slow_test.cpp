// SPDX-License-Identifier: Apache-2.0
// RTL of a new configuration: built at its first use, found at the next, never left half built.
#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNotice = "building the simulator of configuration";

class RtlOnDemand : public ::testing::Test {
 protected:
  /// Verifies a variant of tiny that this build folder has no module of.
  Result verify(Surroundings here = {}, const std::vector<std::string>& more = {}) {
    here.environment.push_back("XDG_CACHE_HOME=" + (cache_ / "cache"));
    here.folder = cache_.path();
    std::vector<std::string> words{"verify",   "--random", "200",   "--class",           "mixed",
                                   "--config", "tiny",     "--set", "radial.entries=128"};
    words.insert(words.end(), more.begin(), more.end());
    return fastsplat(words, here);
  }
  /// Files below the cache with this ending.
  int files(const std::string& ending) {
    int count = 0;
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(cache_.path(), none))
      count += entry.path().string().ends_with(ending) ? 1 : 0;
    return count;
  }
  TempFolder cache_;
};

TEST_F(RtlOnDemand, IsBuiltOnceByTwoThatNeedItAndFoundLater) {
  Result one, other;
  std::thread beside([&] { other = verify(); });
  one = verify();
  beside.join();
  expect_success(one);
  expect_success(other);
  const bool first_built = one.err.find(kNotice) != std::string::npos,
             other_built = other.err.find(kNotice) != std::string::npos;
  EXPECT_NE(first_built, other_built) << one.err << other.err;
  EXPECT_EQ(files(".so"), 1);
  EXPECT_EQ(files(".log") + files(".building") + files(".sv"), 0);
  const auto later = verify();
  expect_success(later);
  EXPECT_EQ(later.err.find(kNotice), std::string::npos) << later.err;
  EXPECT_EQ(later.out, one.out);
}

TEST_F(RtlOnDemand, WithoutToolsIsOneLine) {
  Surroundings bare;
  bare.environment = {"PATH=/nowhere"};
  expect_error(verify(bare), 2, {"verilator", "make", "g++", "apt-get install"});
  EXPECT_EQ(files(".so"), 0);
}

TEST_F(RtlOnDemand, AnInterruptLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Surroundings interrupted;
    interrupted.signal = signal;
    interrupted.when = [&](pid_t) { return files(".cpp") > 5; };  // Verilator has written its sources
    const auto result = verify(interrupted);
    EXPECT_EQ(result.code, 128 + signal) << result.err;
    EXPECT_EQ(files(""), 2) << "more is left than the folders cache/fastsplat";
  }
}

TEST_F(RtlOnDemand, ABuildThatFailsNamesTheToolsWordsAndTheirLog) {
  Surroundings broken;
  broken.environment = {"CXX=" + cache_.write("broken", "#!/bin/sh\necho 'error: no such luck' >&2\nexit 1\n")};
  fs::permissions(cache_ / "broken", fs::perms::owner_all);
  const auto result = verify(broken, {"--quiet"});
  expect_error(result, 70, {"tiny", "no such luck", ".log"});
  EXPECT_EQ(files(".log"), 1);
  EXPECT_EQ(files(".so") + files(".building"), 0);
}

}  // namespace
}  // namespace fastsplat::cli_test
