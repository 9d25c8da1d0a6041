// SPDX-License-Identifier: Apache-2.0
// Pictures for display and for measurement, and the message for a picture too small for the device.
#include <gtest/gtest.h>

#include "base/atomic_file.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Words = std::vector<std::string>;

/// 0 identical, 1 different: as `compare` returns.
int differs(const std::string& a, const std::string& b) {
  return fastsplat({"compare", a, b, "--max-lsb", "0", "--quiet"}).code;
}

TEST(ViewFlags, BackgroundAndNegativeChangePngAndTiffAndNoExr) {
  const TempFolder folder;
  int changed = 0, same = 0;
  for (const std::string engine : {"golden", "cmodel"}) {
    for (const Words& flags : {Words{"--background", "0.2,0.4,0.8"}, {"--method", "xray", "--xray-invert", "on"}}) {
      Words plain{"render", "--volume", "shells:12", "--size", "24", "--engine", engine};
      if (flags[0] == "--method") plain.insert(plain.end(), {"--method", "xray"});
      Words with{"render", "--volume", "shells:12", "--size", "24", "--engine", engine};
      with.insert(with.end(), flags.begin(), flags.end());
      for (const char* ending : {".exr", ".png", ".tif"}) {
        plain.insert(plain.end(), {"-o", folder / std::string("plain") + ending});
        with.insert(with.end(), {"-o", folder / std::string("with") + ending});
      }
      expect_success(fastsplat(plain));
      expect_success(fastsplat(with));
      same += differs(folder / "plain.exr", folder / "with.exr") == 0;
      changed += differs(folder / "plain.png", folder / "with.png") == 1;
      changed += differs(folder / "plain.tif", folder / "with.tif") == 1;
    }
  }
  std::printf("[figure] shown_pictures_changed = %d of 8, exr_kept = %d of 4\n", changed, same);
  EXPECT_EQ(changed, 8);
  EXPECT_EQ(same, 4);
}

TEST(ViewFlags, AreKeptBySavedScenesAndRefusedInOneLine) {
  const TempFolder folder;
  expect_success(
      fastsplat({"render", "--volume", "shells:12", "--size", "24", "--crop", "0..11,0..5,2..9", "--fit", "content",
                 "--background", "1,0.5,0", "--save-scene", folder / "s.toml", "-o", folder / "a.png"}));
  expect_success(fastsplat({"render", "--scene", folder / "s.toml", "-o", folder / "b.png"}));
  EXPECT_EQ(differs(folder / "a.png", folder / "b.png"), 0);
  const auto refused = [&](const Words& flags, const Words& said) {
    Words words{"render", "--volume", "shells:12", "--size", "24", "-o", folder / "c.png"};
    words.insert(words.end(), flags.begin(), flags.end());
    expect_error(fastsplat(words), 2, said);
  };
  refused({"--crop", "0..12,0..5,2..9"}, {"exceeds the volume", "0..11,0..11,0..11"});
  // In a scene file the same value is an error of the file.
  write_text_file(folder / "s.toml", "volume = \"shells:12\"\ncrop = \"0..12,0..5,2..9\"\n");
  expect_error(fastsplat({"render", "--scene", folder / "s.toml", "-o", folder / "x.exr"}), 3,
               {"s.toml:2:8: crop: the box exceeds the volume"});
  refused({"--crop", "5..2,0..5,2..9"}, {"--crop", "A..B,C..D,E..F"});
  refused({"--crop", "0..2,0..5"}, {"--crop"});
  refused({"--background", "2,0,0"}, {"--background", "0..1"});
  refused({"--xray-invert", "on"}, {"--method xray"});
  refused({"--fit", "contents"}, {"did you mean 'content'"});
}

TEST(ViewFlags, AFootprintUnderTwoPixelsIsReported) {
  const Words small{"render", "--volume", "shells:32", "--size", "24", "--engine", "cmodel", "--json", "-"};
  const Result result = fastsplat(small);
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.err.find("pixels wide"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("larger --size"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("snap.phases"), std::string::npos) << result.err;
  std::printf("[figure] said: %s\n", result.err.c_str());
  for (const Words& fine :
       {Words{"render", "--volume", "shells:32", "--size", "96", "--engine", "cmodel", "--json", "-"},
        {"render", "--volume", "shells:32", "--size", "24", "--json", "-"}}) {
    EXPECT_EQ(fastsplat(fine).err.find("pixels wide"), std::string::npos);
  }
}

}  // namespace
}  // namespace fastsplat::cli_test
