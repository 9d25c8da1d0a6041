// SPDX-License-Identifier: Apache-2.0
// Numbers in text: whole words only, and the ends of a double's range.
#include "base/number_text.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace fastsplat {
namespace {

TEST(NumberText, WholeWordsAreNumbers) {
  for (const char* text : {"", "+", "0x10", "1e", "3 ", " 3", "1.2.3", "--1"})
    EXPECT_EQ(double_from(text), std::nullopt) << text;
  for (const auto& [text, value] : {std::pair{"+1.5", 1.5}, {"-2e3", -2000.0}, {".5", 0.5}, {"7.", 7.0}})
    EXPECT_EQ(number_from(text), value) << text;
  EXPECT_TRUE(std::isnan(*double_from("nan")));
  for (const char* text : {"nan", "inf", "-inf", "1e400"}) EXPECT_EQ(number_from(text), std::nullopt) << text;
}

TEST(NumberText, BeyondADoubleIsZeroOrInfinite) {
  const std::string zeros(400, '0');
  int checked = 0;
  for (const auto& [text, value] : {std::pair<std::string, double>{"1e-400", 0.0},
                                    {"-1e-400", 0.0},
                                    {"1e-9999", 0.0},
                                    {"-1E-9999", 0.0},
                                    {"0." + zeros + "1", 0.0},
                                    {"4.9e-324", 4.9e-324},
                                    {"1e400", HUGE_VAL},
                                    {"-1e400", -HUGE_VAL},
                                    {"1e9999", HUGE_VAL},
                                    {"-1" + zeros, -HUGE_VAL}}) {
    EXPECT_EQ(double_from(text), value) << text;
    ++checked;
  }
  std::printf("[figure] numbers at the ends = %d\n", checked);
}

}  // namespace
}  // namespace fastsplat
