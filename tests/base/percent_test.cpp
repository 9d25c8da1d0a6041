// SPDX-License-Identifier: Apache-2.0
// Percent-encoding: every byte there and back, and what is incomplete.
#include "base/percent.hpp"

#include <gtest/gtest.h>

namespace fastsplat {
namespace {

TEST(Percent, EveryByteIsItselfAgain) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  const std::string encoded = percent_encoded(all);
  EXPECT_EQ(encoded.size(), 62U + 3U * 194U);
  EXPECT_EQ(percent_decoded(encoded), all);
  EXPECT_EQ(percent_encoded("a b.c"), "a%20b%2Ec");
}

TEST(Percent, LowerCaseIsReadAndIncompleteOnesStay) {
  EXPECT_EQ(percent_decoded("%2e%2E+"), "..+");
  for (const char* text : {"%", "%2", "%zz", "100%", "%\x10\x11"}) EXPECT_EQ(percent_decoded(text), text);
}

}  // namespace
}  // namespace fastsplat
