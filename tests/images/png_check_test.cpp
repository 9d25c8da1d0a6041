// SPDX-License-Identifier: Apache-2.0
// PNG files with valid checksums and invalid content, built chunk by chunk.
#include "base/images/png_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/images/image_file.hpp"
#include "tests/images/image_helper.hpp"
#include "tests/images/png_helper.hpp"

namespace fastsplat::images {
namespace {

using testing::HasSubstr;

std::string png_defect_of(const std::string& bytes) {
  return png_defect({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

const std::string kPixels = rows({"abc", "def"});

TEST(PngCheck, AcceptsAWholeFileInOneOrManyPieces) {
  const std::string packed = deflated(kPixels);
  EXPECT_EQ(png_defect_of(kSignature + header(3, 2, 8, 0, 0) + chunk("IDAT", packed) + kEnd), "");
  std::string pieces;
  for (const char c : packed) pieces += chunk("IDAT", std::string(1, c)) + chunk("IDAT", "");
  EXPECT_EQ(png_defect_of(kSignature + header(3, 2, 8, 0, 0) + chunk("tEXt", "k\0v") + pieces +
                          chunk("tIME", "1234567") + kEnd),
            "");
}

TEST(PngCheck, AcceptsInterlacedFilesAndTheyRead) {
  // 3 x 2 in Adam7: pass 1 (0,0); passes 2 and 3 have no pixel; pass 4 (2,0); pass 5 none; pass 6 (1,0); pass 7 row 1.
  const std::string file =
      kSignature + header(3, 2, 8, 0, 1) + chunk("IDAT", deflated(rows({"a", "c", "b", "def"}))) + kEnd;
  EXPECT_EQ(png_defect_of(file), "");
  const TempFolder folder;
  write_bytes(folder / "a.png", file);
  const Image image = read_image(folder / "a.png").image;
  std::string codes;
  for (const float value : image.data) codes += static_cast<char>(std::lround(value * 255));
  EXPECT_EQ(codes, "abcdef");
}

TEST(PngCheck, AcceptsPalettesAndFewBits) {
  const std::string palette = chunk("PLTE", std::string("\xff\x00\x00\x00\xff\x00", 6));
  const std::string pixels = chunk("IDAT", deflated(std::string("\0\x40", 2)));  // one row, bits 0 1 0
  const std::string file = kSignature + header(3, 1, 1, 3, 0) + palette + pixels + kEnd;
  EXPECT_EQ(png_defect_of(file), "");
  const TempFolder folder;
  write_bytes(folder / "a.png", file);
  const Image image = read_image(folder / "a.png").image;
  EXPECT_EQ(image.data, (std::vector<float>{1, 0, 0, 0, 1, 0, 1, 0, 0}));
  EXPECT_THAT(png_defect_of(kSignature + header(3, 1, 1, 3, 0) + pixels + kEnd), HasSubstr("no palette"));
}

TEST(PngCheck, NamesEveryDefect) {
  const std::string start = kSignature + header(3, 2, 8, 0, 0);
  const auto pixels = [](const std::string& data) { return chunk("IDAT", deflated(data)); };
  const std::string good = pixels(kPixels);
  const struct {
    std::string bytes;
    const char* expected;
  } cases[] = {
      {"", "signature"},
      {start, "ends inside a chunk at byte 33"},
      {start + good, "ends inside a chunk"},
      {start + kEnd, "pixels are missing before chunk IEND"},
      {start + pixels(rows({"abc"})) + kEnd, "pixels are missing"},
      {start + pixels(rows({"abc", "def", "ghi"})) + kEnd, "more pixels than the header declares"},
      {start + pixels(kPixels + "x") + kEnd, "more pixels"},
      {start +
           pixels("\x05"
                  "abc" +
                  rows({"def"})) +
           kEnd,
       "unknown row filter"},
      {start + chunk("IDAT", deflated(kPixels).substr(0, 6)) + kEnd, "pixels are missing"},
      {start + chunk("IDAT", "not zlib") + kEnd, "bad compressed pixels"},
      {start + chunk("IDAT", deflated(kPixels) + "x") + kEnd, "data after the end"},
      {start + good + chunk("tEXt", "k") + good + kEnd, "misplaced chunk IDAT"},
      {start + header(3, 2, 8, 0, 0) + good + kEnd, "misplaced chunk IHDR"},
      {kSignature + good + kEnd, "misplaced chunk IDAT"},
      {start + chunk("ABCD", "") + good + kEnd, "unknown critical chunk ABCD"},
      {start + chunk("AB D", "") + good + kEnd, "bad chunk type"},
      {kSignature + header(0, 2, 8, 0, 0) + good + kEnd, "bad chunk IHDR"},
      {kSignature + header(3, 2, 7, 0, 0) + good + kEnd, "bad chunk IHDR"},
      {kSignature + header(3, 2, 4, 2, 0) + good + kEnd, "bad chunk IHDR"},
      {kSignature + header(3, 2, 8, 5, 0) + good + kEnd, "bad chunk IHDR"},
      {kSignature + header(3, 2, 8, 0, 2) + good + kEnd, "bad chunk IHDR"},
      {kSignature + header(0x7fffffff, 0x7fffffff, 16, 6, 0) + good + kEnd, "pixels are missing"},
      {start + good + chunk("IEND", "x"), "pixels are missing before chunk IEND"},
  };
  int checked = 0;
  for (const auto& [bytes, expected] : cases) {
    EXPECT_THAT(png_defect_of(bytes), HasSubstr(expected));
    ++checked;
  }
  EXPECT_EQ(checked, 23);
}

}  // namespace
}  // namespace fastsplat::images
