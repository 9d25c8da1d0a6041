// SPDX-License-Identifier: Apache-2.0
// docs/stream.md: every rule broken once must be refused at its beat, and each bit of a stream must affect the model
// exactly as it affects the oracle.
#include <gtest/gtest.h>

#include <functional>

#include "tests/cmodel/small_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"

namespace fastsplat::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The small stream, open to changes by beat and word.
class Edit {
 public:
  void set(std::size_t beat, std::size_t word, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i)
      bytes[beat * cmodel::kBeatBytes + word * 4 + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
  std::uint32_t get(std::size_t beat, std::size_t word) const { return to_beats(bytes)[beat][word]; }
  void erase(std::size_t beat, std::size_t count = 1) {
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(beat * cmodel::kBeatBytes);
    bytes.erase(first, first + static_cast<std::ptrdiff_t>(count * cmodel::kBeatBytes));
  }
  void insert_copy(std::size_t from, std::size_t before) {
    const Bytes copy(bytes.begin() + static_cast<std::ptrdiff_t>(from * cmodel::kBeatBytes),
                     bytes.begin() + static_cast<std::ptrdiff_t>(from * cmodel::kBeatBytes + cmodel::kBeatBytes));
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(before * cmodel::kBeatBytes), copy.begin(), copy.end());
  }
  Bytes bytes = small_stream();
};

struct Rule {
  const char* name;
  std::uint64_t beat;  ///< where it must be refused
  std::function<void(Edit&)> violate;
};

const Rule kRules[] = {
    // S-frame-1, S-frame-3, S-frame-4.
    {"version before", 0, [](Edit& e) { e.set(0, 0, 0x10046); }},
    {"version after", 0, [](Edit& e) { e.set(0, 0, 0x30046); }},
    {"magic", 0, [](Edit& e) { e.set(0, 1, 0x32535346); }},
    {"hash low", 0, [](Edit& e) { e.set(0, 2, e.get(0, 2) ^ 1); }},
    {"hash high", 0, [](Edit& e) { e.set(0, 3, e.get(0, 3) ^ 0x80000000); }},
    {"image width 0", 0, [](Edit& e) { e.set(0, 4, 8U << 16); }},
    {"image height 0", 0, [](Edit& e) { e.set(0, 4, 16); }},
    // S-grammar-1, S-record-4.
    {"first record is not begin_frame", 0, [](Edit& e) { e.erase(0); }},
    {"begin_frame twice", 1, [](Edit& e) { e.insert_copy(0, 1); }},
    {"unknown opcode", 8, [](Edit& e) { e.set(8, 0, 0x52); }},
    // S-table-1, S-table-3, S-table-5.
    {"unknown table", 1, [](Edit& e) { e.set(1, 0, 0x34C); }},
    {"radius set above the last", 1, [](Edit& e) { e.set(1, 1, 3); }},
    {"rho 0", 1, [](Edit& e) { e.set(1, 2, 0); }},
    {"rho of two more columns than words", 1, [](Edit& e) { e.set(1, 2, 3); }},
    {"rho past 32 bits when doubled", 1, [](Edit& e) { e.set(1, 2, 0x80000001); }},
    {"base between lanes", 1, [](Edit& e) { e.set(1, 4, 3); }},
    {"columns past the end", 1, [](Edit& e) { e.set(1, 4, 8); }},
    {"base near 2^32", 1, [](Edit& e) { e.set(1, 4, 0xFFFFFFFE); }},
    {"too few RLUT words", 1, [](Edit& e) { e.set(1, 3, 3); }},
    {"too many RLUT words", 1, [](Edit& e) { e.set(1, 3, 0xFFFFFFFF); }},
    {"RLUT word above the rim", 2, [](Edit& e) { e.set(2, 3, 9); }},
    // S-record-2.
    {"padding", 2, [](Edit& e) { e.set(2, 5, 1); }},
    // S-table-6, S-table-2.
    {"RADIAL words", 3, [](Edit& e) { e.set(3, 3, 5); }},
    {"RADIAL with a set", 3, [](Edit& e) { e.set(3, 1, 1); }},
    {"RADIAL with a rho", 3, [](Edit& e) { e.set(3, 2, 1); }},
    {"RADIAL with a base", 3, [](Edit& e) { e.set(3, 4, 2); }},
    {"RADIAL word above the format", 4, [](Edit& e) { e.set(4, 0, 8); }},
    // S-table-7.
    {"FACTOR words", 5, [](Edit& e) { e.set(5, 3, 2); }},
    {"FACTOR word above 1.0", 6, [](Edit& e) { e.set(6, 0, 17); }},
    {"FACTOR rises", 6, [](Edit& e) { e.set(6, 2, 12); }},
    // S-table-8.
    {"tile without RADIAL", 5, [](Edit& e) { e.erase(3, 2); }},
    {"tile without FACTOR", 5, [](Edit& e) { e.erase(5, 2); }},
    // S-tile-1, S-tile-4, S-tile-2.
    {"mode 3", 7, [](Edit& e) { e.set(7, 0, 0x354); }},
    {"tile number", 7, [](Edit& e) { e.set(7, 1, 1); }},
    {"tile number repeated", 16, [](Edit& e) { e.set(16, 1, 0); }},
    {"more tiles than announced", 16, [](Edit& e) { e.set(0, 5, 1); }},
    {"tile width 0", 7, [](Edit& e) { e.set(7, 4, 8U << 16); }},
    {"tile height 0", 7, [](Edit& e) { e.set(7, 4, 8); }},
    {"tile too wide", 7, [](Edit& e) { e.set(7, 4, 8U << 16 | 9); }},
    {"tile too high", 7,
     [](Edit& e) {
       e.set(0, 4, 9U << 16 | 16);
       e.set(7, 4, 9U << 16 | 8);
     }},
    {"tile left of the image", 7, [](Edit& e) { e.set(7, 2, 0xFFFFFFFF); }},
    {"tile right of the image", 16, [](Edit& e) { e.set(16, 2, 9); }},
    {"tile above the image", 7, [](Edit& e) { e.set(7, 3, 0x80000000); }},
    {"tile below the image", 7, [](Edit& e) { e.set(7, 3, 0x7FFFFFFF); }},
    // S-grammar-1.
    {"load_table after a tile", 16,
     [](Edit& e) {
       e.insert_copy(6, 16);
       e.insert_copy(5, 16);
     }},
    {"begin_tile in a tile", 8, [](Edit& e) { e.insert_copy(7, 8); }},
    {"splat outside a sheet", 8, [](Edit& e) { e.erase(8); }},
    {"cull_block outside a sheet", 13, [](Edit& e) { e.insert_copy(10, 13); }},
    {"begin_sheet in a sheet", 9, [](Edit& e) { e.insert_copy(8, 9); }},
    // S-tile-6.
    {"sheet number repeated", 13, [](Edit& e) { e.set(13, 1, 3); }},
    {"sheet number falls", 13, [](Edit& e) { e.set(13, 1, 2); }},
    {"end_tile in a sheet", 12, [](Edit& e) { e.erase(12); }},
    // S-splat-1, S-splat-3, S-splat-2.
    {"radius set not loaded", 9, [](Edit& e) { e.set(9, 0, 0x50); }},
    {"radius set 255", 9, [](Edit& e) { e.set(9, 0, 0xFF50); }},
    {"tag skipped", 11, [](Edit& e) { e.set(11, 1, 2); }},
    {"tag not from 0 in a tile", 18, [](Edit& e) { e.set(18, 1, 2); }},
    {"x above its format", 9, [](Edit& e) { e.set(9, 2, 128); }},
    {"x below its format", 9, [](Edit& e) { e.set(9, 2, 0xFFFFFF7F); }},
    {"y above its format", 9, [](Edit& e) { e.set(9, 3, 128); }},
    {"y below its format", 9, [](Edit& e) { e.set(9, 3, 0x80000000); }},
    {"R above its format", 9, [](Edit& e) { e.set(9, 4, 256); }},
    {"G above its format", 9, [](Edit& e) { e.set(9, 4, 256U << 16); }},
    {"B above its format", 9, [](Edit& e) { e.set(9, 5, 256); }},
    {"tau above its format", 9, [](Edit& e) { e.set(9, 5, 256U << 16); }},
    // S-cull-1.
    {"cull_block of no width", 10, [](Edit& e) { e.set(10, 4, 5U << 16); }},
    {"cull_block of no height", 10, [](Edit& e) { e.set(10, 4, 4); }},
    // S-tile-8, S-tile-9.
    {"end of another sheet", 12, [](Edit& e) { e.set(12, 1, 4); }},
    {"splat count", 12, [](Edit& e) { e.set(12, 2, 3); }},
    {"end of another tile", 15, [](Edit& e) { e.set(15, 1, 1); }},
    {"sheet count", 15, [](Edit& e) { e.set(15, 2, 1); }},
    // S-file-6, S-file-5.
    {"tiles missing", 21, [](Edit& e) { e.set(0, 5, 3); }},
    {"something after end_frame", 22, [](Edit& e) { e.insert_copy(0, 22); }},
};

// One of its sheets has no splat (S-tile-10).
TEST(StreamRules, TheSmallStreamBreaksNone) {
  EXPECT_FALSE(cmodel::first_violation(small_stream_config()));
  bool taken = false;
  EXPECT_EQ(disagreement(small_stream_config(), small_stream(), &taken), "");
  EXPECT_TRUE(taken);
}

// S-reader-1.
TEST(StreamRules, EachBrokenOnceIsRefusedAtItsBeatWithBothValues) {
  int refused = 0;
  for (const Rule& rule : kRules) {
    Edit edit;
    rule.violate(edit);
    if (edit.bytes[edit.bytes.size() - cmodel::kBeatBytes] == 0x66) seal(edit.bytes);  // so that nothing else is wrong
    const Verdict model = model_verdict(small_stream_config(), edit.bytes);
    ASSERT_TRUE(model.refused_at) << rule.name << ": taken";
    EXPECT_EQ(*model.refused_at, rule.beat) << rule.name << ": " << model.text;
    EXPECT_EQ(model.code, ExitCode::Input) << rule.name;
    EXPECT_FALSE(model.parts.what.empty() || model.parts.expected.empty() || model.parts.got.empty())
        << rule.name << ": " << model.text;
    EXPECT_NE(model.parts.expected, model.parts.got) << rule.name << ": " << model.text;
    EXPECT_EQ(disagreement(small_stream_config(), edit.bytes), "") << rule.name;
    ++refused;
  }
  std::printf("[figure] rules of docs/stream.md broken and refused = %d\n", refused);
  EXPECT_GE(refused, 60);
}

// S-file-6.
TEST(StreamRules, CountAndChecksumOfTheEnd) {
  for (const std::size_t word : {1, 2, 3}) {
    Edit edit;
    edit.set(21, word, edit.get(21, word) ^ 0x10000);
    const Verdict model = model_verdict(small_stream_config(), edit.bytes);
    ASSERT_TRUE(model.refused_at) << "word " << word;
    EXPECT_EQ(*model.refused_at, 21U) << model.text;
    EXPECT_EQ(disagreement(small_stream_config(), edit.bytes), "");
  }
  Edit edit;  // a change that breaks no rule except the checksum
  edit.set(9, 4, edit.get(9, 4) ^ 1);
  const Verdict model = model_verdict(small_stream_config(), edit.bytes);
  ASSERT_TRUE(model.refused_at);
  EXPECT_EQ(*model.refused_at, 21U) << model.text;
}

// S-reader-2.
TEST(StreamRules, TruncatedAnywhereIsRefused) {
  const Bytes whole = small_stream();
  for (std::size_t beats = 0; beats < whole.size() / cmodel::kBeatBytes; ++beats) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(beats * cmodel::kBeatBytes));
    const Verdict model = model_verdict(small_stream_config(), part);
    ASSERT_TRUE(model.refused_at) << beats << " beats are taken as a whole stream";
    EXPECT_EQ(*model.refused_at, beats) << model.text;
    EXPECT_EQ(disagreement(small_stream_config(), part), "");
  }
}

// S-record-3, S-record-4, and all rules that a bit can break.
TEST(StreamRules, EverySingleBitCountsAsTheOracleSays) {
  int flips = 0, taken = 0;
  for (std::size_t bit = 0; bit < small_stream().size() * 8; ++bit) {
    Bytes bytes = small_stream();
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << bit % 8));
    if (bit / 8 < bytes.size() - cmodel::kBeatBytes) seal(bytes);
    bool accepted = false;
    ASSERT_EQ(disagreement(small_stream_config(), bytes, &accepted), "")
        << "bit " << bit % cmodel::kBeatBits << " of beat " << bit / cmodel::kBeatBits;
    ++flips;
    taken += accepted ? 1 : 0;
  }
  std::printf("[figure] single bits flipped = %d, of which still legal = %d\n", flips, taken);
  EXPECT_EQ(flips, 22 * cmodel::kBeatBits);
  EXPECT_GT(taken, 0);
}

}  // namespace
}  // namespace fastsplat::test
