// SPDX-License-Identifier: Apache-2.0
// Issue cycles of windows in a tile whose samples are composited one by one (docs/microarchitecture.md, M-hazard-3).
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/cycles/cycle_stages.hpp"
#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

struct Measured {
  cmodel::CycleAccount account;
  cmodel::StallCounters stalls;
};

Measured measure(const cmodel::Config& config, const std::vector<std::uint8_t>& bytes) {
  cmodel::CycleModel model(config, cmodel::StreamScope::Whole);
  model.consume(to_beats(bytes));
  model.finish();
  return {.account = model.account(), .stalls = model.stalls()};
}

struct InTurn {
  const char* name;
  int dx, dy;        ///< pixels from the even splats to the odd ones
  bool cull;         ///< a hint between any two
  bool every_other;  ///< whether each waits for the previous one
};

/// Splats of one window each, alternating between two places.
std::vector<std::uint8_t> in_turn(const cmodel::Config& config, int mode, const InTurn& pattern, int splats) {
  StreamWriter w(symbols_of(config));
  w.begin_frame(config.tile_width, config.tile_height, 1);
  w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), 1));
  w.load_table(2, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1, 1));
  const auto words = static_cast<std::size_t>(config.lanes) * static_cast<std::size_t>(config.phases);
  w.load_table(0, 0, static_cast<std::uint32_t>(words / 2), 0, std::vector<std::uint32_t>(words, 0));
  w.begin_tile(mode, 0, 0, 0, config.tile_width, config.tile_height);
  w.begin_sheet(0);
  for (int i = 0; i < splats; ++i) {
    if (pattern.cull && i > 0) w.cull_block(0, 0, 0, 1, 1, 1);
    const int odd = i % 2, middle = config.tile_width / 2;
    w.splat(0, (middle + odd * pattern.dx) << config.position_frac_bits,
            (middle + odd * pattern.dy) << config.position_frac_bits, {1, 1, 1, 1});
  }
  w.end_sheet();
  w.end_tile();
  w.end_frame();
  return w.bytes();
}

TEST(EverySampleCycles, OnePlaceGoesOnEveryOtherCycle) {
  constexpr int kSplats = 100;
  for (const char* name : {"tiny", "base", "ellipse"}) {
    const cmodel::Config config = sampling(name);
    const int side = config.lanes;
    for (const InTurn& pattern :
         {InTurn{"one place", 0, 0, false, true}, InTurn{"a corner in common", side - 1, 1 - side, false, true},
          InTurn{"side by side", side, 0, false, false}, InTurn{"one above the other", 0, -side, false, false},
          InTurn{"corner to corner", -side, side, false, false},
          InTurn{"one place, a hint between", 0, 0, true, false}}) {
      const auto samples = measure(config, in_turn(config, 4, pattern, kSplats)),
                 sheets = measure(config, in_turn(config, 0, pattern, kSplats));
      const std::uint64_t waits = pattern.every_other ? kSplats - 1 : 0;
      std::printf("[figure] %s, %s: cycles waited = %llu of %d splats (expected %llu)\n", name, pattern.name,
                  static_cast<unsigned long long>(samples.stalls.stall_hazard), kSplats,
                  static_cast<unsigned long long>(waits));
      EXPECT_EQ(samples.stalls.stall_hazard, waits);  // M-hazard-3
      EXPECT_EQ(samples.account.hazard, waits);  // M-account-4
      // No block is walked (M-sample-5).
      EXPECT_EQ(samples.account.ideal, static_cast<std::uint64_t>(kSplats)) << "windows, and no block";
      EXPECT_EQ(samples.account.total(), samples.stalls.busy);
      EXPECT_EQ(sheets.stalls.stall_hazard, 0U);
      // The page's time of a tile of one sheet (M-account-7), after the tables' time.
      const auto beats = static_cast<std::uint64_t>((config.tile_width + side - 1) / side * config.tile_height);
      const std::uint64_t hints = pattern.cull ? kSplats - 1 : 0;
      EXPECT_EQ(samples.stalls.busy - samples.account.table_load,
                1 + (kSplats + waits + hints + 2) + 15 + (2 + beats) + cmodel::stages::splat_delay(config) + 4)
          << "begin_frame and three headers";
    }
  }
}

/// Footprint taps with their cycles, tile by tile.
struct Windows final : cmodel::TapSink {
  explicit Windows(int side) : lanes(side) {}
  void on_tap(const cmodel::TapRecord& record) override {
    if (record.tap != cmodel::Tap::Footprint) return;
    if (before && before->tile == record.tile) {
      const std::uint64_t apart = record.cycle - before->cycle;
      const bool over = std::abs(record.x - before->x) < lanes && std::abs(record.y - before->y) < lanes;
      EXPECT_GE(apart, over && sampled(record.tile) ? 2U : 1U);  // M-hazard-3
      ++(over ? (apart == 2 ? waited : later) : (apart == 1 ? at_once : later));
    }
    before = record;
  }
  bool sampled(std::uint32_t tile) const { return modes.at(tile) >= cmodel::Mode::SampleExponential; }
  int lanes;
  std::vector<cmodel::Mode> modes;
  std::optional<cmodel::TapRecord> before;
  std::uint64_t waited = 0, at_once = 0, later = 0;
};

TEST(EverySampleCycles, NoWindowIsIssuedRightAfterOneItLiesOver) {
  std::uint64_t waited = 0, at_once = 0;
  Random random(seed_or(82));
  for (const char* name : {"tiny", "small", "ellipse"}) {
    const cmodel::Config config = sampling(name);
    for (int run = 0; run < 40; ++run) {
      const auto beats = to_beats(random_stream(symbols_of(config), random, 120).bytes);
      Windows windows(config.lanes);
      cmodel::StreamDecode decode(config, cmodel::StreamScope::Whole);
      for (const auto& beat : beats) {
        const cmodel::Record* record = decode.feed(beat);
        if (record == nullptr) continue;
        if (const auto* tile = std::get_if<cmodel::BeginTile>(record)) windows.modes.push_back(tile->mode);
      }
      cmodel::CycleModel model(config, cmodel::StreamScope::Whole, {.taps = &windows});
      model.consume(beats);
      model.finish();
      EXPECT_EQ(model.account().total(), model.stalls().busy);
      waited += windows.waited;
      at_once += windows.at_once;
    }
  }
  std::printf("[figure] windows that waited = %llu (limit > 100), that came at once = %llu (limit > 1000)\n",
              static_cast<unsigned long long>(waited), static_cast<unsigned long long>(at_once));
  EXPECT_GT(waited, 100U);
  EXPECT_GT(at_once, 1000U);
}

// C = P^2 (M-sample-1).
TEST(EverySampleCycles, SlicesAreRefused) {
  cmodel::Config config = sampling("tiny");
  for (const int lanes : {0, 4}) {
    config.composite_lanes = lanes;
    EXPECT_FALSE(cmodel::first_violation(config)) << lanes;
  }
  for (const int lanes : {1, 2}) {
    config.composite_lanes = lanes;
    const auto wrong = cmodel::first_violation(config);
    ASSERT_TRUE(wrong) << lanes;
    EXPECT_EQ(wrong->where, "composite.lanes");
    EXPECT_EQ(wrong->got, std::to_string(lanes));
    EXPECT_NE(wrong->expected.find("0 or array.lanes^2 = 4"), std::string::npos) << wrong->expected;
  }
}

}  // namespace
}  // namespace fastsplat::test
