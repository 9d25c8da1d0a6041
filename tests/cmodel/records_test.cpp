// SPDX-License-Identifier: Apache-2.0
// Records into beats and back: nothing is lost, and a table takes the beats that its header announces.
#include "cmodel/stream/records.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

namespace fastsplat::cmodel {
namespace {

std::vector<Beat> beats_of(const Record& record) {
  std::vector<Beat> beats;
  append(beats, record);
  return beats;
}

// S-record-2.
TEST(Records, ATableTakesTheBeatsThatItsHeaderAnnounces) {
  std::size_t words = 0;
  for (; words <= 4 * kBeatWords; ++words) {
    const auto beats = beats_of(LoadTable{Table::Rlut, {}, std::vector<std::uint32_t>(words, 7)});
    EXPECT_EQ(announced_words(beats[0]), words);
    EXPECT_EQ(announced_beats(beats[0]), beats.size() - 1) << words << " words";
    for (std::size_t i = 0; i < (beats.size() - 1) * kBeatWords; ++i)
      EXPECT_EQ(beats[1 + i / kBeatWords][i % kBeatWords], i < words ? 7U : 0U) << words << " words, word " << i;
  }
  // A header that no device takes may announce anything.
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  Beat header = beats_of(LoadTable{})[0];
  put(header, layout::kTableWords, most);
  EXPECT_EQ(announced_beats(header), most / kBeatWords + (most % kBeatWords == 0 ? 0 : 1));
  std::printf("[figure] tables whose beats were counted = %zu\n", words);
}

TEST(Records, HeadersKeepTheirFields) {
  const auto frame =
      std::get<BeginFrame>(from_beat(beats_of(BeginFrame{0x0123456789abcdefU, 17, 65535, 0x89abcdefU})[0]));
  EXPECT_EQ(frame.config_hash, 0x0123456789abcdefU);
  EXPECT_EQ(frame.width, 17);
  EXPECT_EQ(frame.height, 65535);
  EXPECT_EQ(frame.tiles, 0x89abcdefU);
  const auto table = std::get<LoadTable>(from_beat(beats_of(LoadTable{Table::Factor, {3, 5, 8}, {1, 2}})[0]));
  EXPECT_EQ(table.table, Table::Factor);
  EXPECT_EQ(table.radius.set, 3U);
  EXPECT_EQ(table.radius.rho, 5U);
  EXPECT_EQ(table.radius.base, 8U);
}

}  // namespace
}  // namespace fastsplat::cmodel
