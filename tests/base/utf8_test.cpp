// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.hpp"

#include <gtest/gtest.h>

#include <string>

namespace fastsplat {
namespace {

/// A code point in UTF-8, longer than needed on request.
std::string encoded(std::uint32_t point, int length) {
  if (length == 1) return {static_cast<char>(point)};
  std::string out(static_cast<std::size_t>(length), '\0');
  for (int i = length - 1; i > 0; --i, point >>= 6)
    out[static_cast<std::size_t>(i)] = static_cast<char>(0x80 | (point & 0x3f));
  out[0] = static_cast<char>((0xf00 >> length & 0xff) | point);
  return out;
}

int shortest(std::uint32_t point) { return point < 0x80 ? 1 : point < 0x800 ? 2 : point < 0x10000 ? 3 : 4; }

TEST(Utf8, EveryCodePointAtItsShortestAndNoOther) {
  int taken = 0, refused = 0;
  for (std::uint32_t point = 0; point < 0x200000; point += point < 0x11000 ? 1 : 257) {
    const bool is_text = point <= 0x10ffff && !(point >= 0xd800 && point < 0xe000);
    for (int length = shortest(point); length <= 4; ++length) {
      const bool expected = is_text && length == shortest(point);
      ASSERT_EQ(is_utf8(encoded(point, length)), expected) << std::hex << point << " in " << length << " bytes";
      ++(expected ? taken : refused);
    }
  }
  std::printf("[figure] code points taken = %d, refused = %d\n", taken, refused);
}

TEST(Utf8, CutsAndStraysAreSeen) {
  EXPECT_TRUE(is_utf8(""));
  EXPECT_TRUE(is_utf8("caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80"));
  for (const char* bytes :
       {"caf\xe9", "\xc3", "\xe2\x82", "\xf0\x9f\x98", "\xa9", "\xc3\xa9\xa9", "\xff", "\xfe", "\xc3(", "\xe2\x82("})
    EXPECT_FALSE(is_utf8(bytes)) << bytes;
}

}  // namespace
}  // namespace fastsplat
