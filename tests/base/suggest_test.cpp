// SPDX-License-Identifier: Apache-2.0
#include "base/suggest.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>
#include <vector>

namespace fastsplat {
namespace {

TEST(Suggest, DistanceCountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("shells", "shells"), 0);
  EXPECT_EQ(edit_distance("shels", "shells"), 1);    // insertion
  EXPECT_EQ(edit_distance("shellss", "shells"), 1);  // deletion
  EXPECT_EQ(edit_distance("shelks", "shells"), 1);   // substitution
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("inof", "info"), 1);  // neighbours exchanged
  EXPECT_EQ(edit_distance("ab", "ba"), 1);
  EXPECT_EQ(edit_distance("abcdef", "badcfe"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
}

TEST(Suggest, OffersTheNearestElseAll) {
  const std::vector<std::string> known = {"bone", "binary", "x-ray"};
  EXPECT_EQ(suggestion("binray", known), "did you mean 'binary'?");
  EXPECT_EQ(suggestion("bon", known), "did you mean 'bone'?");
  EXPECT_EQ(suggestion("binaryxyz", known), "did you mean 'binary'?");  // 3 edits
  EXPECT_EQ(suggestion("binarywxyz", known), "known: bone, binary, x-ray");
  EXPECT_EQ(suggestion("something else", known), "known: bone, binary, x-ray");
}

TEST(Suggest, DistantNamesAreNotSuggested) {
  // Wrong suggestions of the past: the words share only a letter or two.
  const std::vector<std::string> presets = {"bone", "fire", "base", "linear"}, flags = {"--video", "--volume", "--tf"};
  for (const char* word : {"nope", "none", "mine", "vase-2"}) {
    if (edit_distance(word, "bone") == 1) continue;
    EXPECT_EQ(suggestion(word, presets), "known: bone, fire, base, linear") << word;
  }
  EXPECT_EQ(suggestion("--index", flags), "known: --video, --volume, --tf");
  EXPECT_EQ(suggestion("--vidoe", flags), "did you mean '--video'?");
  EXPECT_EQ(suggestion("--volum", flags), "did you mean '--volume'?");
  EXPECT_EQ(suggestion("bnoe", presets), "did you mean 'bone'?");
  EXPECT_EQ(suggestion("linaer", presets), "did you mean 'linear'?");
}

TEST(Suggest, AWordOfAMegabyteCostsNothing) {
  const std::vector<std::string> known(200, "radius.entries");
  EXPECT_FALSE(may_mean(std::string(1'000'000, 'r'), known[0]));
  EXPECT_TRUE(may_mean("radius.entrie", known[0]));
  EXPECT_TRUE(may_mean("radius.entriess", known[0]));
  // Two hundred edit distances of a megabyte take seconds; comparing lengths takes no time.
  const std::clock_t began = std::clock();
  EXPECT_EQ(suggestion(std::string(1'000'000, 'r'), known).substr(0, 6), "known:");
  const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  std::printf("[figure] seconds of processor for a word of a megabyte = %.3f (limit 0.5)\n", seconds);
  EXPECT_LT(seconds, 0.5);
}

TEST(Suggest, ShortNamesAreNotSuggestedForEverything) {
  const std::vector<std::string> known = {"a", "radius"};  // "a" is within 3 edits of every short word
  EXPECT_EQ(suggestion("xyz", known), "known: a, radius");
}

}  // namespace
}  // namespace fastsplat
