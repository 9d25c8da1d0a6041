// SPDX-License-Identifier: Apache-2.0
// Messages about refused beats: bounds printed as bounds, the true limit, and a fix that fits the error.
#include <gtest/gtest.h>

#include "tests/cmodel/small_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"

namespace fastsplat::test {
namespace {

struct Refused {
  const char* name;
  std::size_t beat, word;
  std::uint32_t value;
  const char* expected;
  const char* got;
  const char* advice;  ///< a part of it
};

constexpr const char* kWriter = "correct the program that wrote the stream";
constexpr const char* kDamaged = "damaged or truncated";

const Refused kRefused[] = {
    {"image width", 0, 4, 8U << 16, "at least 1", "0", kWriter},
    {"magic", 0, 1, 0x32535346, "0x31535346", "0x32535346", ".fss"},
    {"configuration", 0, 2, 0, "(small_stream)", "", "configuration it was recorded with"},
    {"radius set", 1, 1, 3, "at most 2", "3", kWriter},
    {"no radius", 1, 2, 0, "at least 1", "0", kWriter},
    {"radius", 1, 2, 9, "at most 8", "9", kWriter},  // of 8 columns, k = 2: a radius of 4 pixels
    {"unknown table, radius and all", 1, 0, 0x34C, "0, 1 or 2", "3", kWriter},
    {"base", 1, 4, 3, "a multiple of 2", "3", kWriter},
    {"columns", 1, 4, 8, "at most 8", "10", kWriter},
    {"table word", 2, 3, 9, "at most 8", "9", kWriter},
    {"rising", 6, 2, 12, "at most 11", "12", kWriter},
    {"mode", 7, 0, 0x354, "0, 1 or 2", "3", kWriter},
    {"tile begins", 7, 2, 0xFFFFFFFF, "at least 0", "-1", kWriter},
    {"tile ends", 7, 2, 9, "at most 16", "17", kWriter},
    {"sheet numbers", 13, 1, 3, "more than 3", "3", kWriter},
    {"reserved bits", 9, 0, 0x10150, "0 in w0", "0x00010000", kWriter},
    {"splats counted", 12, 2, 1, "2", "1", kWriter},
    {"sheets counted", 15, 2, 3, "2", "3", kWriter},
    {"cull block", 10, 4, 0x50000, "at least 1", "0", kWriter},
    {"unknown opcode", 8, 0, 0x52, "a known opcode", "0x52", kDamaged},
};

std::vector<std::uint8_t> with(std::size_t beat, std::size_t word, std::uint32_t value) {
  auto bytes = small_stream();
  for (std::size_t i = 0; i < 4; ++i)
    bytes[beat * cmodel::kBeatBytes + word * 4 + i] = static_cast<std::uint8_t>(value >> (8 * i));
  return bytes;
}

TEST(StreamMessages, StateTheExpectedValue) {
  for (const Refused& refused : kRefused) {
    const Verdict verdict = model_verdict(small_stream_config(), with(refused.beat, refused.word, refused.value));
    ASSERT_TRUE(verdict.refused_at) << refused.name;
    EXPECT_EQ(*verdict.refused_at, refused.beat) << refused.name << ": " << verdict.text;
    if (refused.expected[0] == '(') {
      EXPECT_NE(verdict.parts.expected.find(refused.expected), std::string::npos) << verdict.text;
    } else {
      EXPECT_EQ(verdict.parts.expected, refused.expected) << refused.name << ": " << verdict.text;
      EXPECT_EQ(verdict.parts.got, refused.got) << refused.name << ": " << verdict.text;
    }
    EXPECT_NE(verdict.parts.fix.find(refused.advice), std::string::npos) << refused.name << ": " << verdict.text;
  }
  std::printf("[figure] messages held = %zu\n", std::size(kRefused));
}

// The limit in the message is the effective one: one less, and the table has too few words.
TEST(StreamMessages, TheLimitOfARadiusIsTheTrueOne) {
  const Verdict at = model_verdict(small_stream_config(), with(1, 2, 8));
  ASSERT_TRUE(at.refused_at);
  EXPECT_EQ(at.text.find("radius too large"), std::string::npos) << at.text;
}

TEST(StreamMessages, ACutStreamNamesTheMissingPart) {
  const auto whole = small_stream();
  const std::pair<std::size_t, const char*> cuts[] = {{0, "begin_frame"},
                                                      {1, "load_table, begin_tile or end_frame"},
                                                      {2, "a beat of table words"},
                                                      {8, "begin_sheet or end_tile"},
                                                      {9, "splat, cull_block or end_sheet"},
                                                      {16, "begin_tile or end_frame"}};
  for (const auto& [beats, expected] : cuts) {
    const Verdict verdict = model_verdict(small_stream_config(), {whole.data(), beats * cmodel::kBeatBytes});
    ASSERT_TRUE(verdict.refused_at) << beats;
    EXPECT_EQ(verdict.parts.expected, expected);
    EXPECT_NE(verdict.parts.fix.find(kDamaged), std::string::npos) << verdict.text;
  }
  auto flipped = with(9, 4, 0);
  const Verdict verdict = model_verdict(small_stream_config(), flipped);
  EXPECT_NE(verdict.text.find("checksum"), std::string::npos) << verdict.text;
  EXPECT_NE(verdict.parts.fix.find(kDamaged), std::string::npos) << verdict.text;
  EXPECT_EQ(verdict.parts.got.substr(0, 2), "0x") << verdict.text;
}

}  // namespace
}  // namespace fastsplat::test
