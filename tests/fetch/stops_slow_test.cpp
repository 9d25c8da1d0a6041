// SPDX-License-Identifier: Apache-2.0
// The fetch master stopped in every cycle of a short run, in front of a device that is played and in front of the RTL.
#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/fetch/fetch_core_helper.hpp"
#include "tests/fetch/stops_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

TEST(FetchStops, WorksAgainAfterAStopInEveryCycle) {
  cmodel::Config config = named_config("tiny");
  config.cull_map = static_cast<int>(cmodel::CullMap::Block);
  Random random(6);
  const FetchStream stream = fetch_stream(
      config, to_beats(random_stream(symbols_of(config), random, 60, SetOrder::Whole).bytes), 0x8'0000'0fa0);
  std::uint64_t runs = 0;
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    FetchRun run{
        .build = build, .memory = {.latency = 9, .has = Pattern("random-60", 5)}, .ready = Pattern("random-60", 3)};
    run.verdict_wait = 12;
    const Stops stops = stop_and_begin_again(stream, run, build == FetchBuild::Default ? 1 : 7);
    EXPECT_EQ(stops.finding, "");
    runs += stops.runs;
  }
  std::printf("[figure] stops with a whole frame after them = %llu\n", static_cast<unsigned long long>(runs));
  EXPECT_GT(runs, 5000U);
}

// The master in front of the RTL: stop, soft reset, and the frame again, as docs/integration.md says (M-fetch-19,
// M-fetch-20, M-fetch-21).
TEST(FetchStops, TheDeviceDrawsTheNextFrame) {
  const cmodel::Config config = named_config("faults/cull");
  struct Tiles final : cmodel::PixelSink {
    std::vector<cmodel::TilePixels> tiles;
    void on_tile(cmodel::TilePixels&& tile) override { tiles.push_back(std::move(tile)); }
  } wanted;
  Random random(9);
  const auto beats = to_beats(random_stream(symbols_of(config), random, 60, SetOrder::Whole).bytes);
  cmodel::Model model(config, cmodel::StreamScope::Whole, wanted);
  model.consume(beats);
  model.finish();
  const FetchStream stream = fetch_stream(config, beats, 0x8'0000'0fa0);
  std::uint64_t runs = 0, words = 0;
  for (FetchRun run{.memory = {.latency = 9}, .stop_at = 1, .again = true};; run.stop_at += 5) {
    const auto core = make_core(config, Pattern("random-80", run.stop_at));
    const FetchResult seen = run_fetch(stream, run, *core);
    ASSERT_EQ(seen.finding, "") << "stop in cycle " << run.stop_at << ", rule " << core->refused();
    if (!seen.stopped) break;
    ASSERT_TRUE(seen.all_sent);
    ASSERT_EQ(core->refused(), 0U);
    ASSERT_EQ(core->tiles().size(), wanted.tiles.size()) << "stop in cycle " << run.stop_at;
    for (std::size_t i = 0; i < wanted.tiles.size(); ++i) {
      ASSERT_EQ(core->tiles()[i].words, wanted.tiles[i].words) << "stop in cycle " << run.stop_at << ", tile " << i;
      words += wanted.tiles[i].words.size();
    }
    ++runs;
  }
  std::printf("[figure] stops = %llu, words equal after them = %llu\n", static_cast<unsigned long long>(runs),
              static_cast<unsigned long long>(words));
  EXPECT_GT(runs, 200U);
}

}  // namespace
}  // namespace fastsplat::test
