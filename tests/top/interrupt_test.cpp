// SPDX-License-Identifier: Apache-2.0
// When fastsplat_top interrupts: behind what the sink has taken, in its cycle (M-top-5). When it is busy: from the
// first beat on that its slice holds (M-top-4).
#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/io/register_map.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/top/top_bench_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

/// Cycles from a tile's last beat to `irq`, which shows bits 1 and 0 of IRQ a cycle late (M-register-5).
constexpr std::uint64_t kTileDelay = 2, kFrameDelay = 3;
constexpr std::uint64_t kBegun = 320;  ///< cycles: memories are wiped, begin_frame is taken

/// Frames of empty tiles of `width` pixels, one row each: of 2 pixels they are a beat each.
std::vector<cmodel::Beat> frames(const std::vector<int>& tiles, int width) {
  const cmodel::Config config = named_config("tiny");
  std::vector<cmodel::Beat> out;
  for (const int count : tiles) {
    StreamWriter w(symbols_of(config));
    w.begin_frame(width, count, static_cast<std::uint32_t>(count));
    w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), 1));
    w.load_table(2, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1, 1));
    for (int tile = 0; tile < count; ++tile) {
      w.begin_tile(2, static_cast<std::uint32_t>(tile), 0, tile, width, 1);
      w.end_tile();
    }
    w.end_frame();
    const auto beats = to_beats(w.bytes());
    out.insert(out.end(), beats.begin(), beats.end());
  }
  return out;
}

const std::vector<int> kTiles = {2, 2, 3, 2, 4, 5};  ///< of the frames

/// The sink is slow enough for each interrupt to be cleared before the next.
TopRun run_with(std::uint32_t mask, const char* sink, std::uint64_t seed) {
  return {.sink = Pattern(sink, seed), .mask = mask};
}

TEST(TopInterrupts, ATilesComesWhenTheSinkTakesItsLastBeat) {
  std::size_t interrupts = 0;
  for (const int width : {2, 6}) {
    for (const char* sink : {"every-9", "every-30"}) {
      const TopResult seen = run_top(frames(kTiles, width), {}, run_with(cmodel::kIrqTile, sink, 1));
      ASSERT_EQ(seen.finding, "");
      ASSERT_EQ(seen.error, 0U);
      ASSERT_EQ(seen.interrupts.size(), seen.lasts.size());
      for (std::size_t i = 0; i < seen.lasts.size(); ++i)
        ASSERT_EQ(seen.interrupts[i], seen.lasts[i] + kTileDelay) << "tile " << i << ", " << sink;
      interrupts += seen.interrupts.size();
    }
  }
  std::printf("[figure] interrupts of tiles in their cycle = %zu\n", interrupts);
  EXPECT_GT(interrupts, 50U);
}

/// Each behind the last beat of its frame: the sink is so slow that the device has carried out end_frame by then.
void expect_frames(const TopResult& seen, const std::vector<int>& tiles) {
  ASSERT_EQ(seen.finding, "");
  ASSERT_EQ(seen.error, 0U);
  ASSERT_EQ(seen.interrupts.size(), tiles.size());
  std::size_t last = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    last += static_cast<std::size_t>(tiles[i]);
    ASSERT_EQ(seen.interrupts[i], seen.lasts[last - 1] + kFrameDelay) << "frame " << i;
  }
}

TEST(TopInterrupts, AFramesComesWhenTheSinkTakesItsLastBeat) {
  std::size_t interrupts = 0;
  for (const int width : {2, 6}) {
    for (const char* sink : {"every-40", "every-60"}) {
      const TopResult seen = run_top(frames(kTiles, width), {}, run_with(cmodel::kIrqFrame, sink, 1));
      expect_frames(seen, kTiles);
      interrupts += seen.interrupts.size();
    }
  }
  std::printf("[figure] interrupts of frames behind their last beat = %zu\n", interrupts);
  EXPECT_GT(interrupts, 20U);
}

// Tiles of one beat: the slice holds two frames at once.
TEST(TopInterrupts, TwoFramesInTheSliceInterruptTwice) {
  const std::vector<int> tiles(6, 1);
  std::size_t interrupts = 0;
  for (const char* sink : {"every-400", "every-700"}) {
    const TopResult seen = run_top(frames(tiles, 2), {}, run_with(cmodel::kIrqFrame, sink, 1));
    expect_frames(seen, tiles);
    interrupts += seen.interrupts.size();
  }
  std::printf("[figure] interrupts of frames of one beat = %zu\n", interrupts);
  EXPECT_EQ(interrupts, 12U);
}

// What was counted in front of it is forgotten.
TEST(TopInterrupts, AHardResetForgetsTilesOnTheirWay) {
  const auto first = frames({7}, 6), next = frames({2, 1, 3}, 2);
  std::uint64_t resets = 0;
  for (TopRun run = run_with(cmodel::kIrqFrame, "every-40", 1);; run.reset_at += 7) {
    if (run.reset_at == 0) run.reset_at = kBegun, run.hard = true;
    const TopResult seen = run_top(first, next, run);
    if (!seen.reset) break;
    expect_frames(seen, {2, 1, 3});
    if (HasFatalFailure()) FAIL() << "reset in cycle " << run.reset_at;
    ++resets;
  }
  std::printf("[figure] hard resets = %llu\n", static_cast<unsigned long long>(resets));
  EXPECT_GT(resets, 20U);
}

// An address taken in the cycle of the beat reads in the next one, in which the slice holds the beat (M-register-1).
TEST(TopStatus, IsBusyFromTheFirstBeatOn) {
  TopRun run{.source = Pattern("every-400", 1)};  // the memories are wiped by then
  const auto beats = frames({1}, 2);
  const std::uint64_t taken = run_top(beats, {}, run).first_taken;
  ASSERT_GT(taken, kBegun);
  int reads = 0;
  for (run.status_at = taken - 9; run.status_at < taken + 3; ++run.status_at, ++reads) {
    const TopResult seen = run_top(beats, {}, run);
    ASSERT_EQ(seen.finding, "");
    EXPECT_EQ(seen.busy, run.status_at >= taken) << "cycle " << run.status_at << ", beat in " << taken;
  }
  std::printf("[figure] reads of STATUS around the first beat = %d\n", reads);
}

}  // namespace
}  // namespace fastsplat::test
