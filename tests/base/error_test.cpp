// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace fastsplat {
namespace {

TEST(Error, PartsMakeOneSentence) {
  EXPECT_EQ(one_line({.where = "f.nrrd:3", .what = "bad size", .expected = "1..9", .got = "12", .fix = "correct it"}),
            "f.nrrd:3: bad size (expected 1..9, got 12); correct it");
  EXPECT_EQ(one_line({.where = "", .what = "bad", .expected = "x", .got = "", .fix = ""}), "bad (expected x)");
  EXPECT_EQ(one_line({.where = "", .what = "bad", .expected = "", .got = "y", .fix = ""}), "bad (got y)");
  EXPECT_EQ(one_line({.where = "", .what = "bad", .expected = "", .got = "", .fix = ""}), "bad");
}

TEST(Error, StaysOnOneLineWhateverAFileSays) {
  const std::string line =
      one_line({.where = "a\nb", .what = "\x1b[31mred\x7f", .expected = "\t", .got = "", .fix = "\r"});
  for (const unsigned char c : line) EXPECT_TRUE(c >= 0x20 && c != 0x7f) << static_cast<int>(c);
  EXPECT_NE(line.find("\\x1b[31mred\\x7f"), std::string::npos) << line;
}

TEST(Error, AMegabyteFromAFileIsShortened) {
  const std::string line = one_line({.where = "f",
                                     .what = "unknown key '" + std::string(1'000'000, 'a') + "'",
                                     .expected = {},
                                     .got = std::string(1'000'000, 'b'),
                                     .fix = "correct it"});
  std::printf("[figure] characters = %zu (limit 10000)\n", line.size());
  EXPECT_LT(line.size(), 10000u);
  EXPECT_TRUE(line.starts_with("f: unknown key 'aaa")) << line;
  EXPECT_TRUE(line.ends_with("bbb); correct it")) << line;
}

TEST(Error, CarriesItsExitCode) {
  try {
    throw_input({.where = "f", .what = "w", .expected = "", .got = "", .fix = ""});
    FAIL() << "nothing thrown";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Input);
    EXPECT_EQ(error.parts().where, "f");
    EXPECT_STREQ(error.what(), "f: w");
  }
  EXPECT_THROW(throw_usage({.where = "", .what = "w", .expected = "", .got = "", .fix = ""}), UserError);
}

}  // namespace
}  // namespace fastsplat
