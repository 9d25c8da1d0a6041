// SPDX-License-Identifier: Apache-2.0
#include "base/printable.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "base/error.hpp"
#include "base/json_text.hpp"
#include "base/utf8.hpp"

namespace fastsplat {
namespace {

TEST(Printable, NoByteMovesACursor) {
  EXPECT_EQ(printable("a\x1b[31mred\x7f"), "a\\x1b[31mred\\x7f");
  EXPECT_EQ(printable("a\nb\rc\td\r\n"), "a b c d  ");
  EXPECT_EQ(printable("caf\xe9"), "caf\\xe9");
  EXPECT_EQ(printable("caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x99\x82"), "caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x99\x82");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "what ESC [ is in one character";
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut in a character";
  EXPECT_EQ(printable_lines("a\n\tb\r\nc\rd\x1b\n"), "a\n\tb\r\nc\\x0dd\\x1b\n");
}

TEST(Printable, EveryPairOfBytesBecomesVisibleUtf8) {
  int checked = 0;
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string text = printable(std::string{static_cast<char>(first), static_cast<char>(second)});
      ASSERT_TRUE(is_utf8(text)) << first << " " << second;
      for (const unsigned char c : text) ASSERT_TRUE(c >= 0x20 && c != 0x7f) << first << " " << second;
      ASSERT_EQ(printable(text), text);
      ++checked;
    }
  }
  std::printf("[figure] pairs = %d\n", checked);
}

TEST(Printable, LineBreaksAndDirectionMarksAreEscaped) {
  EXPECT_EQ(printable("a\u202egnp.b"), "a\\xe2\\x80\\xaegnp.b");
  EXPECT_EQ(printable("a\u2028b\u2066c\u200fd"), "a\\xe2\\x80\\xa8b\\xe2\\x81\\xa6c\\xe2\\x80\\x8fd");
  EXPECT_EQ(printable("\u2026 \u2020 \u00d7"), "\u2026 \u2020 \u00d7");
}

TEST(Printable, JsonKeepsItsMeaning) {
  EXPECT_EQ(without_controls("[\"a\xc2\x9b\x7f\xc2\xa9\xc3\x82\"]"), "[\"a\\u009b\\u007f\xc2\xa9\xc3\x82\"]");
  EXPECT_EQ(without_controls("\xc2"), "\xc2");
}

TEST(Printable, MessagesAre) {
  EXPECT_EQ(one_line({.where = "b\x1b.exr", .what = "caf\xe9", .expected = {}, .got = {}, .fix = {}}),
            "b\\x1b.exr: caf\\xe9");
}

}  // namespace
}  // namespace fastsplat
