// SPDX-License-Identifier: Apache-2.0
// Memory, fetch master and device together: the picture is the model's whatever the memory does, and where it is
// regular the device takes the cycles that `cycles --fetch` counts.
#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/fetch/fetch_core_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

struct Tiles final : cmodel::PixelSink {
  std::vector<cmodel::TilePixels> tiles;
  void on_tile(cmodel::TilePixels&& tile) override { tiles.push_back(std::move(tile)); }
};

struct Expected {
  FetchStream stream;
  Tiles picture;
  cmodel::CullLog log;
};

Expected expect(const cmodel::Config& config, std::uint64_t seed, std::uint64_t splats) {
  Random random(seed);
  const auto beats = to_beats(random_stream(symbols_of(config), random, splats, SetOrder::Whole).bytes);
  Expected out{.stream = fetch_stream(config, beats, kAddress), .picture = {}, .log = {}};
  cmodel::Model model(config, cmodel::StreamScope::Whole, out.picture);
  model.log_culls(&out.log);
  model.consume(beats);
  model.finish();
  return out;
}

/// Words that differ from the model's, of all tiles.
std::uint64_t different(const std::vector<cmodel::TilePixels>& seen, const std::vector<cmodel::TilePixels>& wanted,
                        std::uint64_t& words) {
  if (seen.size() != wanted.size()) return ~std::uint64_t{0};
  std::uint64_t out = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].words.size() != wanted[i].words.size()) return ~std::uint64_t{0};
    for (std::size_t j = 0; j < seen[i].words.size(); ++j) out += seen[i].words[j] != wanted[i].words[j] ? 1 : 0;
    words += seen[i].words.size();
  }
  return out;
}

// The device of a subset's reader: what a fetching source leaves out changes no word and no counter (N-6.1-8,
// S-cull-9, S-cull-10, M-cull-15). The end's number of beats and checksum are still the whole stream's (S-file-7).
TEST(FetchedStream, IsTheModelsToo) {
  std::uint64_t words = 0, left_out = 0;
  for (const char* name : {"tiny", "small", "faults/cull", "ellipse"}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      cmodel::Config config = named_config(name);
      config.cull_map = static_cast<int>(seed % 2 == 0 ? cmodel::CullMap::Block : cmodel::CullMap::Pixel);
      const Expected expected = expect(config, 40 + seed, 200);
      std::vector<cmodel::Beat> sent;
      std::uint64_t swallowed = 0;  // of commands whose sets are not asked about
      for (const std::size_t beat : expected.stream.wanted()) {
        sent.push_back(expected.stream.beats[beat]);
        const int set = expected.stream.set_of[beat];
        swallowed += set >= 0 && expected.stream.hidden[static_cast<std::size_t>(set)] ? 1 : 0;
      }
      Tiles seen;
      cmodel::Model fetched(config, cmodel::StreamScope::Subset, seen);
      cmodel::CullLog log;
      fetched.log_culls(&log);
      fetched.consume(sent);
      fetched.finish();
      EXPECT_EQ(different(seen.tiles, expected.picture.tiles, words), 0U) << name;
      EXPECT_EQ(fetched.culls().dropped, swallowed);  // of trusted sets (M-fetch-4)
      EXPECT_EQ(log, expected.log);
      left_out += expected.stream.beats.size() - sent.size();
    }
  }
  std::printf("[figure] words compared = %llu, beats left out = %llu\n", static_cast<unsigned long long>(words),
              static_cast<unsigned long long>(left_out));
  EXPECT_GT(left_out, 100U);
}

// M-fetch-10
TEST(FetchedDevice, TakesTheCycleModelsCycles) {
  const cmodel::Config config = named_config("faults/cull");
  std::uint64_t words = 0, busy = 0, unsent = 0, waited = 0;
  for (const unsigned latency : {1U, 3U, 17U, 40U}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const Expected expected = expect(config, 10 * latency + seed, 300);
      const Pattern always;
      const auto core = make_core(config, always);
      const FetchResult seen = run_fetch(expected.stream, {.memory = {.latency = latency}}, *core);
      ASSERT_EQ(seen.finding, "") << "latency " << latency << ", seed " << seed << ", rule " << core->refused();
      EXPECT_EQ(core->refused(), 0U);
      EXPECT_EQ(different(core->tiles(), expected.picture.tiles, words), 0U);
      cmodel::CycleOptions options{
          .first_beat = seen.offered.front(), .sliced = true, .culls = &expected.log, .fetch = cmodel::Fetch{latency}};
      cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, options);
      cycles.consume(expected.stream.beats);
      cycles.finish();
      const cmodel::StallCounters stalls = core->stalls();
      const std::uint64_t mask = (std::uint64_t{1} << config.counter_bits) - 1;
      EXPECT_EQ(stalls.busy, cycles.stalls().busy & mask) << "latency " << latency << ", seed " << seed;
      EXPECT_EQ(stalls.stall_input, cycles.stalls().stall_input & mask);
      EXPECT_EQ(stalls.stall_buffer, cycles.stalls().stall_buffer & mask);
      EXPECT_EQ(stalls.stall_tile, cycles.stalls().stall_tile & mask);
      EXPECT_EQ(core->counters().windows, cycles.counters().windows & mask);
      busy += cycles.stalls().busy, waited += cycles.account().input;
      unsent += expected.stream.beats.size() - cycles.sent().total();
    }
  }
  std::printf(
      "[figure] busy cycles equal = %llu, of them waits for beats = %llu, beats never sent = %llu, words equal = "
      "%llu\n",
      static_cast<unsigned long long>(busy), static_cast<unsigned long long>(waited),
      static_cast<unsigned long long>(unsent), static_cast<unsigned long long>(words));
  EXPECT_GT(unsent, 30U);
}

// M-fetch-11, through the device
TEST(FetchedDevice, DrawsTheModelsPictureFromAnyMemory) {
  const cmodel::Config config = named_config("faults/cull");
  std::uint64_t words = 0, cycles = 0, unsent = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Expected expected = expect(config, 500 + seed, 250);
    const Pattern output(seed % 3 == 0 ? "random-40" : "always", seed);
    const auto core = make_core(config, output);
    const FetchRun run{.build = seed % 2 == 0 ? FetchBuild::Default : FetchBuild::Narrow,
                       .memory = {.latency = 5,
                                  .more_latency = static_cast<unsigned>(seed % 4 * 30),
                                  .takes = Pattern("random-40", seed),
                                  .has = Pattern(seed % 3 == 1 ? "burst-50" : "random-60", seed + 1),
                                  .seed = seed},
                       .commands = Pattern("random-30", seed)};
    const FetchResult seen = run_fetch(expected.stream, run, *core);
    ASSERT_EQ(seen.finding, "") << "seed " << seed << ", rule " << core->refused();
    EXPECT_EQ(core->refused(), 0U);
    EXPECT_EQ(different(core->tiles(), expected.picture.tiles, words), 0U) << "seed " << seed;
    cycles += seen.cycles, unsent += expected.stream.beats.size() - seen.taken.size();
  }
  std::printf("[figure] words equal = %llu, cycles = %llu, beats never sent = %llu\n",
              static_cast<unsigned long long>(words), static_cast<unsigned long long>(cycles),
              static_cast<unsigned long long>(unsent));
  EXPECT_GT(unsent, 30U);
}

}  // namespace
}  // namespace fastsplat::test
