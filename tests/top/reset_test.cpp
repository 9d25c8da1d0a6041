// SPDX-License-Identifier: Apache-2.0
// Resets of fastsplat_top in one cycle after another: the next frame comes out whole (docs/integration.md).
#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/top/top_bench_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

std::vector<cmodel::Beat> frame(std::uint64_t seed) {
  Random random(seed);
  return to_beats(random_stream(symbols_of(named_config("tiny")), random, 40).bytes);
}

struct Tiles final : cmodel::PixelSink {
  std::vector<std::vector<std::uint32_t>> tiles;
  void on_tile(cmodel::TilePixels&& tile) override { tiles.push_back(std::move(tile.words)); }
};

Tiles tiles_of(const std::vector<cmodel::Beat>& beats) {
  Tiles out;
  cmodel::Model model(named_config("tiny"), cmodel::StreamScope::Whole, out);
  model.consume(beats);
  model.finish();
  return out;
}

/// Of tiles that are whole: those of the frame before may come out in front of the next one's.
void expect_next_frame(const TopResult& seen, const Tiles& next, std::uint64_t& words) {
  ASSERT_EQ(seen.finding, "");
  EXPECT_EQ(seen.error, 0U);
  ASSERT_GE(seen.tiles.size(), next.tiles.size());
  const std::size_t before = seen.tiles.size() - next.tiles.size();
  for (std::size_t i = 0; i < next.tiles.size(); ++i) {
    ASSERT_EQ(seen.tiles[before + i], next.tiles[i]) << "tile " << i;
    words += next.tiles[i].size();
  }
}

/// Resets in one cycle after another from `from` on, until the frame has come out before.
std::uint64_t reset_in_cycles(TopRun run, std::uint64_t from, std::uint64_t step, std::uint64_t& words) {
  const auto first = frame(3), next = frame(4);
  const Tiles wanted = tiles_of(next);
  std::uint64_t resets = 0;
  for (run.reset_at = from;; run.reset_at += step) {
    const TopResult seen = run_top(first, next, run);
    if (!seen.reset) return resets;
    expect_next_frame(seen, wanted, words);
    if (::testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << "reset in cycle " << run.reset_at;
      return 0;
    }
    ++resets;
  }
}

// In any cycle of a frame (M-check-10, M-check-11); what the source still sends of it is dropped (M-check-14).
// CONTROL's bits 1 and 2 (M-register-6, M-top-7), together and bit 1 alone.
TEST(Top, TheNextFrameIsWholeBehindASoftReset) {
  std::uint64_t resets = 0, words = 0;
  for (const char* sink : {"always", "random-30", "burst-90"})
    resets += reset_in_cycles({.source = Pattern("random-80", 2), .sink = Pattern(sink, 3)}, 1, 29, words);
  constexpr std::uint64_t begun = 320;  // cycles: memories are wiped, begin_frame is taken
  resets += reset_in_cycles({.drops = false, .source = Pattern("random-80", 2), .sink = Pattern("random-30", 3)}, begun,
                            29, words);
  std::printf("[figure] soft resets = %llu, words of the next frames equal = %llu\n",
              static_cast<unsigned long long>(resets), static_cast<unsigned long long>(words));
  EXPECT_GT(resets, 100U);
  EXPECT_GT(words, 1000U);
}

// M-top-9. CONTROL without RESET drops and resets nothing (M-top-7), nor does an address whose word has not come.
TEST(Top, OtherWritesToControlResetNothing) {
  const auto beats = frame(3);
  const Tiles wanted = tiles_of(beats);
  std::vector<TopRun> runs;
  constexpr unsigned kAllStrobes = 15;
  for (unsigned strobe = 0; strobe < kAllStrobes; ++strobe) runs.push_back({.harmless = 6, .strobe = strobe});
  for (const std::uint32_t word : {0U, 1U, 4U, 8U}) {
    runs.push_back({.harmless = word});
    runs.push_back({.harmless = word, .address_first = true});
  }
  int writes = 0;
  for (TopRun& run : runs) {
    for (run.reset_at = 300; run.reset_at < 1500; run.reset_at += 100) {
      const TopResult seen = run_top(beats, {}, run);
      ASSERT_EQ(seen.finding, "") << "cycle " << run.reset_at << ", strobe " << run.strobe << ", word "
                                  << *run.harmless;
      ASSERT_EQ(seen.tiles, wanted.tiles)
          << "cycle " << run.reset_at << ", strobe " << run.strobe << ", word " << *run.harmless;
      EXPECT_EQ(seen.error, 0U);
      ++writes;
    }
  }
  std::printf("[figure] writes that reset nothing = %d\n", writes);
}

// The source continues where it was: the rest of its frame is not a frame.
// Its beats are dropped without an error, up to the next begin_frame (M-check-14, M-top-6).
TEST(Top, TheNextFrameIsFoundBehindAHardReset) {
  std::uint64_t resets = 0, words = 0;
  constexpr std::uint64_t begun = 320;  // cycles: memories are wiped, begin_frame is taken
  for (const std::size_t more : {0U, 1U, 40U}) {
    resets += reset_in_cycles(
        {.hard = true, .more = more, .source = Pattern("random-80", 2), .sink = Pattern("random-60", 3)}, begun, 23,
        words);
  }
  // Beats that come when the device could take them: its memories are wiped.
  resets += reset_in_cycles({.hard = true, .more = 40, .source = Pattern("every-16", 2)}, begun, 499, words);
  std::printf("[figure] hard resets = %llu, words of the next frames equal = %llu\n",
              static_cast<unsigned long long>(resets), static_cast<unsigned long long>(words));
  EXPECT_GT(resets, 50U);
}

}  // namespace
}  // namespace fastsplat::test
