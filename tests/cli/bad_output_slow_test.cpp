// SPDX-License-Identifier: Apache-2.0
// Results that cannot be written: exit 3, one line, no file under the final name, no temporary file.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

// Every way in which the program writes a file: the arguments for a path, and the ending it needs.
struct Writer {
  std::string ending;
  std::function<std::vector<std::string>(const std::string&)> arguments;
};

std::vector<std::string> small_render(std::vector<std::string> more) {
  std::vector<std::string> all{"render", "--volume", "shells:12", "--size", "40"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Writer> writers(const std::string& image) {
  return {
      {".exr",
       [](const auto& path) {
         return small_render({"-o", path});
       }},
      {".png",
       [](const auto& path) {
         return small_render({"-o", path});
       }},
      {".tif",
       [](const auto& path) {
         return small_render({"-o", path});
       }},
      {".exr",
       [](const auto& path) {
         return small_render({"--engine", "cmodel", "--raw", path});
       }},
      {".json",
       [](const auto& path) {
         return small_render({"--json", path, "--quiet"});
       }},
      {".toml",
       [](const auto& path) {
         return small_render({"--save-scene", path});
       }},
      {".fss",
       [](const auto& path) {
         return std::vector<std::string>{"stream", "record", "--volume", "shells:12", "--size", "40", "-o", path};
       }},
      {".nrrd",
       [](const auto& path) {
         return std::vector<std::string>{"volume", "convert", "shells:12", path};
       }},
      {".nhdr",
       [](const auto& path) {
         return std::vector<std::string>{"volume", "convert", "shells:12", path};
       }},
      {".nii",
       [](const auto& path) {
         return std::vector<std::string>{"volume", "convert", "shells:12", path};
       }},
      {".nii.gz",
       [](const auto& path) {
         return std::vector<std::string>{"volume", "convert", "shells:12", path};
       }},
      {".png",
       [image](const auto& path) {
         return std::vector<std::string>{"compare", image, image, "--map", path};
       }},
      {".png",
       [image](const auto& path) {
         return std::vector<std::string>{"compare", image, image, "--heat", path};
       }},
      {".json",
       [image](const auto& path) {
         return std::vector<std::string>{"compare", image, image, "--json", path, "--quiet"};
       }},
  };
}

// Progress lines may have gone to stdout before the disk was full; only the error line and the code count.
void expect_write_error(const Result& result, const std::string& path) {
  EXPECT_EQ(result.signal, 0) << "crashed";
  EXPECT_EQ(result.code, 3) << result.err;
  std::string last = result.err.substr(0, result.err.size() - (result.err.empty() ? 0 : 1));
  last = last.substr(last.rfind('\n') + 1);
  EXPECT_EQ(last.rfind("fastsplat: error: ", 0), 0u) << result.err;
  // An .nhdr may fail in its data file, which has its own ending.
  EXPECT_NE(last.find(path.substr(0, path.rfind("out") + 3)), std::string::npos) << last;
  EXPECT_NE(last.find("; "), std::string::npos) << "no fix in: " << last;
}

class BadOutput : public ::testing::Test {
 protected:
  void SetUp() override {
    image_ = images_ / "image.exr";
    expect_success(fastsplat(small_render({"-o", image_})));
  }
  TempFolder images_, folder_;
  std::string image_;
};

TEST_F(BadOutput, TheFolderDoesNotExist) {
  for (const auto& writer : writers(image_)) {
    const auto path = folder_ / "missing/out" + writer.ending;
    expect_error(fastsplat(writer.arguments(path)), 3, {path});
  }
  EXPECT_TRUE(folder_.entries().empty());
}

TEST_F(BadOutput, TheFolderIsAFile) {
  folder_.write("file", "x");
  for (const auto& writer : writers(image_)) {
    const auto path = folder_ / "file/out" + writer.ending;
    expect_error(fastsplat(writer.arguments(path)), 3, {path});
  }
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{"file"});
}

TEST_F(BadOutput, TheNameIsADirectory) {
  for (const auto& writer : writers(image_)) {
    const auto path = folder_ / "out" + writer.ending;
    std::filesystem::create_directory(path);
    expect_error(fastsplat(writer.arguments(path)), 3, {path, "directory"});
    std::filesystem::remove(path);
  }
}

TEST_F(BadOutput, TheFileSystemIsReadOnly) {
  // /proc accepts no new files, not even from root.
  for (const auto& writer : writers(image_)) {
    const auto path = "/proc/fastsplat-out" + writer.ending;
    expect_error(fastsplat(writer.arguments(path)), 3, {path});
  }
}

TEST_F(BadOutput, TheFileSizeIsLimited) {
  // Below the smallest file, above what the checks before the work write (nothing).
  Surroundings limited;
  limited.largest_file = 200;
  for (const auto& writer : writers(image_)) {
    SCOPED_TRACE(writer.ending);
    const auto path = folder_ / "out" + writer.ending;
    expect_write_error(fastsplat(writer.arguments(path), limited), path);
    EXPECT_TRUE(folder_.entries().empty()) << folder_.entries().front();
  }
}

TEST_F(BadOutput, TheDiskIsFull) {
  const std::filesystem::path place = folder_ / "disk";
  const TinyDisk disk(place, 4096);
  if (!disk.mounted()) GTEST_SKIP() << disk.reason();
  std::ofstream(place / "filler") << std::string(4096, 'x');
  for (const auto& writer : writers(image_)) {
    SCOPED_TRACE(writer.ending);
    const auto path = (place / "out").string() + writer.ending;
    expect_write_error(fastsplat(writer.arguments(path)), path);
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(place)) files += entry.path().filename() != "filler";
    EXPECT_EQ(files, 0);
  }
}

TEST_F(BadOutput, AnExistingResultSurvivesAFailure) {
  Surroundings limited;
  limited.largest_file = 200;
  for (const auto& writer : writers(image_)) {
    const auto path = folder_.write("out" + writer.ending, "precious");
    expect_write_error(fastsplat(writer.arguments(path), limited), path);
    EXPECT_EQ(read_bytes(path), "precious");
    EXPECT_EQ(folder_.entries().size(), 1u);
    std::filesystem::remove(path);
  }
}

TEST_F(BadOutput, DevicesAreNotReplaced) {
  expect_error(fastsplat({"volume", "convert", "shells:8", "/dev/null"}), 3, {"/dev/null"});
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
  expect_success(fastsplat({"volume", "info", "shells:8", "--json", "/dev/null"}));
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST_F(BadOutput, StdoutThatTakesNothing) {
  Surroundings full;
  full.stdout_to = "/dev/full";
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"help"},
                                                    {"--version"},
                                                    {"doctor"},
                                                    {"config", "show", "base"},
                                                    {"volume", "info", "shells:8", "--json", "-"}}) {
    expect_error(fastsplat(arguments, full), 3, {"standard output"});
  }
  Surroundings closed;
  closed.stdout_closed = true;
  expect_error(fastsplat({"help"}, closed), 3, {"standard output"});
}

TEST_F(BadOutput, ClosedDescriptorsDoNotLeakIntoResults) {
  Surroundings closed;
  closed.stdin_closed = closed.stdout_closed = closed.stderr_closed = true;
  const auto result =
      fastsplat(small_render({"--quiet", "-o", folder_ / "out.exr", "--json", folder_ / "out.json"}), closed);
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(read_bytes(folder_ / "out.exr"), read_bytes(image_));
  EXPECT_EQ(read_bytes(folder_ / "out.json").front(), '{');
}

TEST_F(BadOutput, AClosedPipeIsNotAnError) {
  expect_success(fastsplat({"stream", "record", "--volume", "shells:32", "--size", "100", "-o", folder_ / "s.fss"}));
  Surroundings head;
  head.stop_reading_after = 100;
  const auto result = fastsplat({"stream", "dump", folder_ / "s.fss"}, head);
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
}

TEST_F(BadOutput, LinksKeepPointingWhereTheyDid) {
  std::filesystem::create_directory(folder_ / "real");
  std::filesystem::create_symlink("real/target.exr", folder_ / "link.exr");
  expect_success(fastsplat(small_render({"-o", folder_ / "link.exr"})));
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.exr"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "real/target.exr"));
}

}  // namespace
}  // namespace fastsplat::cli_test
