// SPDX-License-Identifier: Apache-2.0
#include "base/folder_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace fastsplat {
namespace {

TEST(FolderLock, OneProcessAtATime) {
  constexpr int kProcesses = 8, kTurns = 50;
  const auto folder = std::filesystem::temp_directory_path() / ("fastsplat-lock-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  const auto file = folder / "count";
  write_text_file(file, "0");
  for (int child = 0; child < kProcesses; ++child) {
    if (::fork() != 0) continue;
    for (int turn = 0; turn < kTurns; ++turn) {
      const FolderLock lock(turn % 2 == 0 ? file : folder / "sub/../count");
      int count = 0;
      std::ifstream(file) >> count;
      write_text_file(file, std::to_string(count + 1));
    }
    ::_exit(0);
  }
  int failed = 0;
  for (int child = 0; child < kProcesses; ++child) {
    int status = 0;
    ::wait(&status);
    failed += status != 0 ? 1 : 0;
  }
  int count = 0;
  std::ifstream(file) >> count;
  std::filesystem::remove_all(folder);
  std::printf("[figure] counted by %d processes = %d\n", kProcesses, count);
  EXPECT_EQ(failed, 0);
  EXPECT_EQ(count, kProcesses * kTurns);
}

TEST(FolderLock, AMissingFolderIsReported) { EXPECT_THROW(FolderLock("/nonexistent/x"), UserError); }

}  // namespace
}  // namespace fastsplat
