// SPDX-License-Identifier: Apache-2.0
// Text around the rows of a PLY, and files of formats other than PLY and .splat.
#include <gtest/gtest.h>

#include <cstdio>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<const char*> kPlyFormats{"ascii", "binary_little_endian", "binary_big_endian"};

std::string twelve(const std::string& format) { return table_of(make_synthetic_gaussians("shells:12")).text(format); }

/// Comments behind every line of the header, and lines that end as Windows has them.
TEST(GaussianLayout, CommentsAnywhereAndBothLineEnds) {
  const GaussianCloud whole = make_synthetic_gaussians("shells:12");
  for (const std::string format : kPlyFormats) {
    const std::string text = twelve(format);
    const std::size_t end = text.find("end_header\n");
    for (const char* line : {"comment made by a tool\n", "obj_info num_cols 4\n", "comment\n", "\n", "  \n"}) {
      for (const char* line_end : {"\n", "\r\n"}) {
        std::string header;
        for (const char c : text.substr(0, end)) {
          if (c != '\n') {
            header += c;
            continue;
          }
          header += line_end;
          header += replaced(line, "\n", line_end);
        }
        const TestFile file(".ply", header + "end_header" + line_end + text.substr(end + 11));
        const GaussianCloud read = load_gaussians(file.path());
        EXPECT_LT(difference(read, whole), 1e-6) << format << ' ' << line;
        EXPECT_THAT(read.remarks, ElementsAre());
      }
    }
  }
}

// A comment may be long, and an element without properties may declare any number of rows.
TEST(GaussianLayout, LongCommentsAndRowsOfNothing) {
  for (const std::string format : kPlyFormats) {
    const std::string lines = "comment " + std::string(100'000, 'x') + "\nelement none 18446744073709551615\n";
    const TestFile file(".ply", replaced(twelve(format), "element vertex", lines + "element vertex"));
    EXPECT_EQ(load_gaussians(file.path()).gaussians.size(), 12U) << format;
  }
}

TEST(GaussianLayout, EmptyBytesBehindTheLastRowArePassedOver) {
  const GaussianCloud whole = make_synthetic_gaussians("shells:12");
  for (const std::string format : kPlyFormats) {
    for (const std::string& behind :
         {std::string("\n"), std::string("\r\n"), std::string(" \t\n"), std::string(3, '\0'), std::string(200, '\0')}) {
      const TestFile file(".ply", twelve(format) + behind);
      const GaussianCloud read = load_gaussians(file.path());
      EXPECT_LT(difference(read, whole), 1e-6) << format;
      EXPECT_THAT(read.remarks, ElementsAre()) << format;
    }
    // Surplus bytes are reported if they are a row or more; meaningful bytes are not skipped.
    const TestFile padded(".ply", twelve(format) + std::string(4096, '\0'));
    const GaussianCloud read = load_gaussians(padded.path());
    EXPECT_EQ(read.gaussians.size(), 12U);
    EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("empty bytes after the last row")));
    for (const char* behind : {"\n1 2 3\n", "x"}) {
      const TestFile longer(".ply", twelve(format) + behind);
      EXPECT_THAT([&] { load_gaussians(longer.path()); }, ::testing::ThrowsMessage<UserError>(HasSubstr("longer")));
    }
  }
}

// Elements after the vertices belong to the file: it ends after them.
TEST(GaussianLayout, ElementsBehindTheVerticesAreCounted) {
  const std::string others =
      "element extrinsic 2\nproperty float extrinsic\nelement version 3\nproperty uchar version\n";
  const std::string text = replaced(twelve("binary_little_endian"), "end_header\n", others + "end_header\n");
  const std::string behind("\0\0\x80\x3f\0\0\x80\x3f\1\5\0", 11);
  const TestFile whole(".ply", text + behind), cut(".ply", text + behind.substr(0, 10)),
      more(".ply", text + behind + "x");
  EXPECT_EQ(load_gaussians(whole.path()).gaussians.size(), 12U);
  EXPECT_THAT([&] { load_gaussians(cut.path()); }, ::testing::ThrowsMessage<UserError>(HasSubstr("shorter")));
  EXPECT_THAT([&] { load_gaussians(more.path()); }, ::testing::ThrowsMessage<UserError>(HasSubstr("longer")));
}

std::string large_splat() {
  const TestFile file(".splat", "");
  save_gaussians(make_synthetic_gaussians("cloud:400"), file.path());
  return bytes_of(file.path());
}

TEST(OtherFormats, AreNamedByContentAndByEnding) {
  const std::string sog = std::string("PK\3\4", 4) + std::string(26, '\0') + "means_l.webp" + std::string(99, 'x');
  const struct {
    const char* name;
    std::string ending, bytes;
    std::vector<const char*> said;
  } files[] = {
      {"spz by ending", ".SPZ", "nothing", {"not an .spz file"}},
      {"gzip", ".ply", gzipped(twelve("ascii")), {"a gzip file", "gunzip"}},
      {"ksplat by ending", ".ksplat", "nothing", {"not a .ksplat file"}},
      {"sog named ply", ".ply", sog, {"no directory"}},
      {"sog by ending", ".sog", "nothing", {"no directory"}},
      {"zip", ".ply", std::string("PK\3\4", 4) + std::string(99, 'x'), {"a zip archive", "unpack"}},
      {"checkpoint", ".ckpt", std::string("PK\3\4", 4) + std::string(99, 'x'), {"checkpoint", "ns-export"}},
      {"splat named ply", ".ply", large_splat(), {".splat file with another extension", "rename"}},
      {"splat named dat", ".dat", large_splat(), {".splat file with another extension", "rename"}},
      {"text", ".txt", "hello world", {".ply, .splat, .spz, .sog, .ksplat or glTF"}},
  };
  for (const auto& one : files) {
    const TestFile file(one.ending, one.bytes);
    try {
      load_gaussians(file.path());
      ADD_FAILURE() << one.name << " was taken";
    } catch (const UserError& error) {
      std::printf("%s\n", error.what());
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_THAT(error.what(), HasSubstr(file.path().string()));
      for (const char* words : one.said) EXPECT_THAT(error.what(), HasSubstr(words)) << one.name;
    }
  }
}

// A PLY is one under any name: read as .splat it would be noise.
TEST(OtherFormats, PlyIsReadUnderAnyName) {
  for (const char* ending : {".splat", ".txt", ".PLY", ""}) {
    const TestFile file(ending, twelve("binary_little_endian"));
    EXPECT_EQ(load_gaussians(file.path()).gaussians.size(), 12U) << ending;
  }
}

// A missing file is reported missing, whatever its ending.
TEST(OtherFormats, MissingFilesAreMissing) {
  for (const char* name : {"there-is-none.spz", "there-is-none.ply", "there-is-none.splat"})
    EXPECT_THAT([&] { load_gaussians(name); }, ::testing::ThrowsMessage<UserError>(HasSubstr("no such file"))) << name;
}

}  // namespace
}  // namespace fastsplat::scene
