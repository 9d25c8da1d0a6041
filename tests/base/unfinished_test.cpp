// SPDX-License-Identifier: Apache-2.0
#include "base/unfinished.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>

namespace fastsplat {
namespace {

namespace fs = std::filesystem;

class Unfinished : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("fastsplat-unfinished-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name) const {
    std::ofstream(folder_ / name) << "half";
    return folder_ / name;
  }
  bool there(const std::string& name) const { return fs::exists(folder_ / name); }

  fs::path folder_;
};

TEST_F(Unfinished, IsRemovedUnlessItIsKept) {
  {
    const UnfinishedPath half(write("half"));
    UnfinishedPath whole(write("whole"));
    whole.keep();
    const UnfinishedPath never(folder_ / "never");
  }
  EXPECT_FALSE(there("half"));
  EXPECT_TRUE(there("whole"));
}

TEST_F(Unfinished, ASignalRemovesFilesThenTheirFolder) {
  fs::create_directory(folder_ / "made");
  fs::create_directory(folder_ / "full");
  write("full/of another");
  const UnfinishedPath made(folder_ / "made"), full(folder_ / "full");  // named before its contents
  const UnfinishedPath first(write("made/first")), second(write("made/second"));
  UnfinishedPath kept(write("kept"));
  kept.keep();
  remove_unfinished_files();
  EXPECT_FALSE(there("made"));
  EXPECT_TRUE(there("full/of another"));
  EXPECT_TRUE(there("kept"));
}

/// A child that writes a file again and again, like one that outlives its parent.
pid_t writing_child(const fs::path& path) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::alarm(20);  // even if the test fails
  for (;;) {
    std::ofstream(path) << "more";
    ::usleep(500);
  }
}

TEST_F(Unfinished, ASignalEndsHelpersBeforeTheirFilesAreRemoved) {
  const pid_t child = writing_child(folder_ / "file");
  const UnfinishedPath file(folder_ / "file");
  {
    const HelperProcess helper(child);
    while (!there("file")) ::usleep(500);
    remove_unfinished_files();
  }
  ::usleep(20'000);
  EXPECT_FALSE(there("file")) << "it was written again";
  errno = 0;
  const int left = ::kill(child, 0);
  std::printf("[figure] kill(child, 0) = %d, errno %d (expected -1, ESRCH %d)\n", left, errno, ESRCH);
  EXPECT_EQ(left, -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST_F(Unfinished, AHelperReportsHowItEnded) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(7);
  const int status = HelperProcess(child).wait();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

// Its parent is killed, which no handler can catch; the end of the grandchild closes the pipe.
TEST_F(Unfinished, AChildEndsWithItsParentHoweverThatEnds) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    const pid_t self = ::getpid();
    if (::fork() == 0) {
      end_with_parent(self);
      [[maybe_unused]] const auto written = ::write(ends[1], "x", 1);
      ::alarm(20);
      ::pause();
      ::_exit(0);
    }
    ::pause();
    ::_exit(0);
  }
  ::close(ends[1]);
  char byte = 0;
  ASSERT_EQ(::read(ends[0], &byte, 1), 1);
  const auto begin = std::chrono::steady_clock::now();
  ::kill(parent, SIGKILL);
  EXPECT_EQ(::read(ends[0], &byte, 1), 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("[figure] seconds until the child has ended = %.3f (limit 10)\n", seconds);
  EXPECT_LT(seconds, 10.0);
  ::waitpid(parent, nullptr, 0);
  ::close(ends[0]);
}

}  // namespace
}  // namespace fastsplat
