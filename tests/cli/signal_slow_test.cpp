// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and other signals: exit 130, no temporary file, no file under the final name.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

// Too long for any machine to finish before the signal.
std::vector<std::string> long_recording(const std::string& out) {
  return {"stream", "record", "--volume", "shells:200", "--size", "2000", "--slab-width", "0.25", "-o", out, "--quiet"};
}

// True once a file in the folder has begun to grow.
std::function<bool(pid_t)> writing_in(const TempFolder& folder) {
  return [&folder](pid_t) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path(), ignored)) {
      if (entry.file_size(ignored) > 0) return true;
    }
    return false;
  };
}

TEST(Signals, CtrlCWhileWritingRemovesTheTemporaryFile) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TempFolder folder;
    Surroundings interrupted;
    interrupted.signal = signal;
    interrupted.when = writing_in(folder);
    const auto result = fastsplat(long_recording(folder / "s.fss"), interrupted);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.code, 128 + signal) << result.err;
    EXPECT_TRUE(folder.entries().empty()) << folder.entries().front();
  }
}

TEST(Signals, CtrlCWhileRenderingIsExit130) {
  const TempFolder folder;
  Surroundings interrupted;
  interrupted.signal = SIGINT;
  interrupted.when = [](pid_t process) { return handles_signal(process, SIGINT); };
  const auto result =
      fastsplat({"render", "--volume", "shells:200", "--size", "3000", "--method", "raycast", "-o", folder / "a.exr"},
                interrupted);
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_TRUE(folder.entries().empty());
}

// A folder that it created is removed; one that existed stays.
TEST(Signals, CtrlCWhileWritingVectorsRemovesTheFolder) {
  const TempFolder folder;
  expect_success(fastsplat(
      {"stream", "record", "--volume", "shells:64", "--size", "256", "--config", "tiny", "-o", folder / "s.fss"}));
  std::filesystem::create_directory(folder / "there");
  for (const std::string name : {"made", "there"}) {
    Surroundings interrupted;
    interrupted.signal = SIGINT;
    interrupted.when = [&](pid_t) {
      std::error_code ignored;
      for (const auto& entry : std::filesystem::directory_iterator(folder / name, ignored))
        if (entry.file_size(ignored) > 0) return true;
      return false;
    };
    const auto result =
        fastsplat({"stream", "vectors", folder / "s.fss", "--config", "tiny", "-o", folder / name}, interrupted);
    EXPECT_EQ(result.code, 130) << result.err;
  }
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"s.fss", "there"}));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "there"));
}

}  // namespace
}  // namespace fastsplat::cli_test
