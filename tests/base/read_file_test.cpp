// SPDX-License-Identifier: Apache-2.0
#include "base/read_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "base/error.hpp"

namespace fastsplat {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ReadFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("fastsplat-read-file-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static std::string message(const fs::path& path) {
    try {
      read_text_file(path, 100);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Input);
      return error.what();
    }
    ADD_FAILURE() << path << " was read";
    return {};
  }

  fs::path folder_;
};

TEST_F(ReadFile, ReadsEveryByte) {
  const std::string text("a\0b\r\n\xff", 6);
  EXPECT_EQ(read_text_file(write("f", text)), text);
}

TEST_F(ReadFile, SaysWhyNot) {
  write("scene.toml", "x");
  EXPECT_THAT(message(folder_ / "scene.tml"), HasSubstr("did you mean '" + (folder_ / "scene.toml").string()));
  EXPECT_THAT(message(folder_ / "nothing like it"), HasSubstr("no such file"));
  EXPECT_THAT(message(folder_ / "no" / "such" / "folder"), HasSubstr("does not exist"));
  EXPECT_THAT(message(folder_), HasSubstr("directory"));
  EXPECT_THAT(message(write("empty", "")), HasSubstr("empty"));
  EXPECT_THAT(message(write("large", std::string(101, 'x'))), HasSubstr("expected at most 100 bytes, got 101 bytes"));
  EXPECT_THAT(message("/dev/null"), HasSubstr("not a regular file"));
}

TEST_F(ReadFile, DoesNotHangOnAPipe) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(message(pipe), HasSubstr("not a regular file"));
}

TEST_F(ReadFile, PermissionDenied) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const fs::path path = write("secret", "x");
  ::chmod(path.c_str(), 0);
  EXPECT_THAT(message(path), HasSubstr("permission denied"));
}

}  // namespace
}  // namespace fastsplat
