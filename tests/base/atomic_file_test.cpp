// SPDX-License-Identifier: Apache-2.0
#include "base/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "base/error.hpp"
#include "base/read_file.hpp"

namespace fastsplat {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class AtomicFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("fastsplat-atomic-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string message(const fs::path& path, const std::string& text = "x") {
    try {
      write_text_file(path, text);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Input);
      return error.what();
    }
    ADD_FAILURE() << path << " was written";
    return {};
  }

  fs::path folder_;
};

TEST_F(AtomicFileTest, AppearsWholeOrNotAtAll) {
  const fs::path path = folder_ / "v.nii.gz";
  {
    AtomicFile file(path);
    EXPECT_EQ(file.temporary().parent_path(), folder_);
    EXPECT_TRUE(file.temporary().string().ends_with(".nii.gz"));
    std::ofstream(file.temporary()) << "half";
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_EQ(files(), 0u);  // given up: nothing is left
  {
    AtomicFile file(path);
    std::ofstream(file.temporary()) << "whole";
    file.commit();
  }
  EXPECT_EQ(read_text_file(path), "whole");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, ReplacesALinksTarget) {
  write_text_file(folder_ / "target", "old");
  fs::create_symlink("target", folder_ / "link");
  write_text_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_text_file(folder_ / "target"), "new");
}

TEST_F(AtomicFileTest, SaysWhyNot) {
  EXPECT_THAT(message(folder_), HasSubstr("directory"));
  EXPECT_THAT(message(folder_ / "no" / "file"), HasSubstr("does not exist"));
  if (::geteuid() != 0) {
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THAT(message(folder_ / "file"), HasSubstr("ermission"));
    fs::permissions(folder_, fs::perms::owner_all);
  }
}

TEST_F(AtomicFileTest, AFullDiskKeepsTheOldFile) {
  const fs::path path = folder_ / "file";
  write_text_file(path, "old");
  // A limit on file size stands for a full disk: write() fails half-way.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 4096, .rlim_max = before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string text = message(path, std::string(100000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(text, HasSubstr("cannot write"));
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, AnInterruptRemovesUnfinishedFiles) {
  AtomicFile file(folder_ / "file");
  EXPECT_EQ(files(), 1u);
  remove_unfinished_files();
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace fastsplat
