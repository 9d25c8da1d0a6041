// SPDX-License-Identifier: Apache-2.0
#include "base/nesting.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace fastsplat {
namespace {

std::string times(std::size_t count, const std::string& text) {
  std::string out;
  while (count-- > 0) out += text;
  return out;
}

constexpr std::size_t kMany = kDeepestNesting + 1;

TEST(Nesting, EveryWayToNestIsCounted) {
  const std::string many = times(kMany, "a."), half = times(kDeepestNesting / 2, "a.");
  const std::vector<std::string> deep{
      many + "a = 1",
      "[" + many + "a]",
      "[[" + many + "a]]",
      "\xc2\xa0[" + many + "a]",             // a blank that is not ASCII
      "[" + half + "a]\n" + half + "a = 1",  // a header and a key add up
      half + "a = {" + half + "a = 1}",      // so do a key and a table
      "x = " + times(kMany, "[") + times(kMany, "]"),
      "x = " + times(kMany, "{a = ") + "1" + times(kMany, "}"),
      "x = [\"\"\"a\"\"\"\", {" + many + "a = 1}]",  // four quotes close a string
      "x = '''a''''\n" + many + "a = 1",
      "x = \"\\\"\"\n" + many + "a = 1",
      "x = '\\'\n" + many + "a = 1",
      "# \"\n" + many + "a = 1",
      "x = [ # ]\n" + many + "]\n" + many + "a = 1\n" + times(kMany, "["),
  };
  for (const auto& text : deep) EXPECT_TRUE(toml_too_deep(text)) << text;
  std::printf("[figure] TOML texts refused = %zu\n", deep.size());
}

TEST(Nesting, ShallowTextThatLooksDeepIsRead) {
  const std::string many = times(kMany, "a."), numbers = times(kMany, "1.5, ");
  const std::vector<std::string> flat{
      "x = [" + numbers + "2.5]",
      times(kMany, "x = 1.5\n"),
      times(kMany, "a.b = 1\n[a.b]\n"),
      "x = \"" + many + times(kMany, "[") + "\"",
      "x = '''\n" + many + "\n" + times(kMany, "{") + "'''",
      "\"" + many + "\" = 1",
      "# " + many + times(kMany, "["),
      "x = [" + times(kMany, "{a.b = 1, c.d = 2}, ") + "]",
      times(kMany, "]"),
  };
  for (const auto& text : flat) EXPECT_FALSE(toml_too_deep(text)) << text;
  std::printf("[figure] TOML texts taken = %zu\n", flat.size());
}

TEST(Nesting, OfJson) {
  EXPECT_TRUE(json_too_deep(times(kMany, "[") + times(kMany, "]")));
  EXPECT_EQ(json_too_deep(times(kMany, "{\"a\":") + "1" + times(kMany, "}")), 5 * kDeepestNesting);
  EXPECT_FALSE(json_too_deep(times(kDeepestNesting, "[") + times(kDeepestNesting, "]")));
  EXPECT_FALSE(json_too_deep("\"" + times(kMany, "[") + "\\\"" + times(kMany, "{") + "\""));
  EXPECT_FALSE(json_too_deep(times(kMany, "[],")));
  std::printf("[figure] levels = %zu\n", kDeepestNesting);
}

}  // namespace
}  // namespace fastsplat
