// SPDX-License-Identifier: Apache-2.0
// Numbered names, and the refused ones.
#include "cli/frame_names.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace fastsplat::cli {
namespace {

TEST(FrameNames, ArePaddedToTheWidthOfTheRun) {
  const FrameNames names("a#b/head.####.png", 10000);
  EXPECT_EQ(names(0), "a#b/head.0000.png");
  EXPECT_EQ(names(9999), "a#b/head.9999.png");
  EXPECT_EQ(FrameNames("#", 10)(7), "7");
  EXPECT_EQ(FrameNames("x.##", 10)(7), "x.07");
}

TEST(FrameNames, AsAPrintfFormat) { EXPECT_EQ(FrameNames("50%/##% done.png", 3).format(), "50%%/%02d%% done.png"); }

TEST(FrameNames, WithoutOneFittingRunAreRefusedWithAFix) {
  struct Bad {
    const char* pattern;
    int frames;
    const char* said;
  };
  for (const Bad& bad :
       {Bad{"head.png", 3, "no place"}, Bad{"a##/head.png", 3, "no place"}, Bad{"##-##.png", 3, "two places"},
        Bad{"h.#.png", 11, "write ##"}, Bad{"h.###.png", 1001, "write ####"}, Bad{"", 3, "no place"}}) {
    try {
      FrameNames(bad.pattern, bad.frames);
      ADD_FAILURE() << bad.pattern << " was accepted";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      EXPECT_NE(std::string(error.what()).find(bad.said), std::string::npos) << error.what();
    }
  }
}

TEST(FrameNames, NameTheNumberedItem) {
  try {
    FrameNames("s#.fss", 18, "stream");
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "s#.fss: 1 # cannot number 18 streams; write ##");
  }
  try {
    FrameNames("a#b#.fss", 18, "stream");
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_STREQ(
        error.what(),
        "a#b#.fss: the name has two places for the stream number (expected one group of # in the file name); for "
        "example stream.####.fss");
  }
}

}  // namespace
}  // namespace fastsplat::cli
