// SPDX-License-Identifier: Apache-2.0
// The cycle model of a culling device: beat by beat against a clock, and against a device without culling.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/io/fetch_commands.hpp"
#include "cmodel/model.hpp"
#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/plain_cull_clock_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

struct Times final : cmodel::CycleSink {
  std::vector<BeatTimes> beats;
  void on_beat(const cmodel::BeatCycles& beat) override {
    beats.push_back({beat.taken, beat.entered, beat.left});
    opcodes.push_back(static_cast<int>(beat.opcode));
  }
  std::vector<int> opcodes;
  void on_sheet(const cmodel::SheetCycles&) override {}
  void on_tile(const cmodel::TileCycles&) override {}
};

struct Tally {
  std::uint64_t beats = 0, unsent = 0, waited = 0, hidden = 0, map = 0, starved = 0, later = 0;
};

/// Every beat sent, and fetching sources with memories of these latencies.
const std::optional<std::uint64_t> kSources[] = {{}, 0, 3, 50};

void compare(const cmodel::Config& config, std::span<const cmodel::Beat> beats,
             std::span<const std::optional<std::uint64_t>> sources, Tally& tally) {
  Collector seen;
  cmodel::CullLog log;
  cmodel::Model model(config, cmodel::StreamScope::Whole, seen);
  model.log_culls(&log);
  model.consume(beats);
  for (const std::optional<std::uint64_t> latency : sources) {
    Times times;
    cmodel::CycleOptions options{.spans = &times, .culls = &log};
    if (latency) options.fetch = cmodel::Fetch{*latency};
    cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, options);
    cycles.consume(beats);
    cycles.finish();
    const PlainCullClock clock = plain_cull_clock(config, beats, latency);
    ASSERT_EQ(times.beats.size(), clock.beats.size());
    for (std::size_t i = 0; i < times.beats.size(); ++i) {
      const auto text = [](const BeatTimes& beat) {
        return std::to_string(beat.taken) + " " + std::to_string(beat.entered) + " " + std::to_string(beat.left);
      };
      // M-reset-5, M-check-2, M-check-3, M-decode-1, M-decode-2, M-decode-5, M-walk-4; M-cull-3, M-cull-4, M-cull-6,
      // M-cull-8 to M-cull-12; M-fetch-8
      ASSERT_EQ(text(times.beats[i]), text(clock.beats[i]))
          << "beat " << i << " of " << times.beats.size() << ", latency " << latency.value_or(9999) << ", opcode "
          << times.opcodes[i] << " behind " << times.opcodes[i - 1] << " of " << text(times.beats[i - 1]);
    }
    EXPECT_EQ(cycles.account().total(), cycles.stalls().busy);
    EXPECT_EQ(cycles.stalls().stall_input, clock.starved);  // with the waits for tables (M-cull-18)
    tally.starved += clock.starved;
    EXPECT_EQ(cycles.counters().splats, model.counters().splats);
    EXPECT_EQ(cycles.counters().windows, model.counters().windows);
    EXPECT_EQ(cycles.counters().dirty_blocks, model.counters().dirty_blocks);
    EXPECT_EQ(cycles.counters().sheets, model.counters().sheets);
    EXPECT_EQ(cycles.counters().cull_blocks, model.counters().cull_blocks);
    EXPECT_EQ(cycles.stalls().hidden_splats, model.culls().hidden_splats);
    EXPECT_EQ(cycles.stalls().hidden_windows, model.culls().hidden_windows);
    EXPECT_EQ(cycles.sent().total(), times.beats.size());
    if (!latency) {
      EXPECT_EQ(cycles.sent().total(), beats.size());
      const cmodel::StreamBeats& sent = cycles.sent();
      const cmodel::Counters& counted = cycles.counters();
      // Dropped splats are sent and not counted.
      EXPECT_EQ(sent.splats, static_cast<std::uint64_t>(std::ranges::count_if(times.opcodes, [](int opcode) {
                  return opcode == static_cast<int>(cmodel::Opcode::Splat) ||
                         opcode == static_cast<int>(cmodel::Opcode::Ellipse);
                })));
      EXPECT_GE(sent.splats, counted.splats);
      EXPECT_EQ(sent.cull_blocks, counted.cull_blocks);
      EXPECT_EQ(sent.sheets, 2 * counted.sheets);
      EXPECT_EQ(sent.tiles, 2 * counted.tiles);
      EXPECT_EQ(sent.frame, 2U);
    }
    tally.beats += times.beats.size();
    tally.unsent += beats.size() - times.beats.size();
    tally.waited += clock.waited;
    tally.hidden += cycles.account().hidden;
    tally.map += cycles.account().map;
  }
}

TEST(CullCycles, AreThoseOfAClock) {
  Random random(seed_or(95));
  Tally tally;
  for (const char* name : {"tiny", "small", "base", "ellipse"}) {
    for (const auto map : {cmodel::CullMap::Block, cmodel::CullMap::Pixel}) {
      for (int i = 0; i < 6; ++i) {
        cmodel::Config config = named_config(name);
        config.cull_map = static_cast<int>(map);
        if (i % 3 == 1) config.composite_lanes = config.lanes;
        const auto whole = random_stream(symbols_of(config), random, 200, SetOrder::Whole);
        compare(config, to_beats(whole.bytes), kSources, tally);
        if (HasFatalFailure()) return;
        const auto any = random_stream(symbols_of(config), random, 100);
        compare(config, to_beats(any.bytes), std::span(kSources).first(1), tally);
        if (HasFatalFailure()) return;
      }
    }
  }
  std::printf(
      "[figure] beats compared = %llu, not sent = %llu, cycles begin_sheet waited for a table = %llu, without "
      "a beat = %llu, of the account: hidden = %llu, map = %llu\n",
      static_cast<unsigned long long>(tally.beats), static_cast<unsigned long long>(tally.unsent),
      static_cast<unsigned long long>(tally.waited), static_cast<unsigned long long>(tally.starved),
      static_cast<unsigned long long>(tally.hidden), static_cast<unsigned long long>(tally.map));
  EXPECT_GT(tally.unsent, 500U);
  EXPECT_GT(tally.waited, 500U);
  // Such causes exist (M-cull-16); their cycles are not compared.
  EXPECT_GT(tally.hidden, 500U);
  EXPECT_GT(tally.map, 500U);
}

/// An opaque corner, an empty sheet, and splats whose rows have 128 windows: the answers of a row lie in several words.
std::vector<std::uint8_t> wide_splats(const cmodel::Config& config) {
  StreamWriter w(symbols_of(config));
  const int lanes = config.lanes, one = 1 << config.position_frac_bits;
  const auto words = [](int count, int word) {
    return std::vector<std::uint32_t>(static_cast<std::size_t>(count), static_cast<std::uint32_t>(word));
  };
  w.begin_frame(config.tile_width, config.tile_height, 1);
  w.load_table(1, 0, 0, 0, words(config.radial_entries, (1 << (config.radial_int_bits + config.radial_frac_bits)) - 1));
  w.load_table(2, 0, 0, 0, words(config.opacity_segments + 1, 1 << config.opacity_frac_bits));
  const int rims[] = {config.rlut_columns * config.phases / 2, lanes * config.phases / 2};
  for (const std::uint32_t set : {0U, 1U})
    w.load_table(0, set, static_cast<std::uint32_t>(rims[set]), 0, words(2 * rims[set], 0));
  w.begin_tile(0, 0, 0, 0, config.tile_width, config.tile_height);
  const auto full = static_cast<std::uint32_t>(config.colour_format().max);
  w.begin_sheet(0);
  for (int y = 0; y < 4 * lanes; y += lanes)
    for (int x = 0; x < config.tile_width / 2; x += lanes)
      w.splat(1, (x + lanes / 2 - 1) * one, (y + lanes / 2 - 1) * one, {full, full, full, full});
  w.end_sheet();
  w.begin_sheet(1);
  w.end_sheet();
  w.begin_sheet(2);
  for (const int x : {-100, -1, 37, 64, 100, 200}) w.splat(0, x * one, 9 * one, {1, 1, 1, 1});
  w.splat(0, 127 * one, 135 * one, {1, 1, 1, 1});  // its first 64 windows are seen, the next are not
  w.end_sheet();
  w.end_tile();
  w.end_frame();
  return w.bytes();
}

TEST(CullCycles, OfRowsOf128Windows) {
  cmodel::Config config = named_config("base");
  config.lanes = 2, config.rlut_columns = 256, config.rlut_sets = 2;
  Tally tally;
  for (const auto map : {cmodel::CullMap::Block, cmodel::CullMap::Pixel}) {
    config.cull_map = static_cast<int>(map);
    compare(config, to_beats(wide_splats(config)), kSources, tally);
    if (HasFatalFailure()) return;
  }
  std::printf("[figure] beats compared = %llu, hidden cycles = %llu\n", static_cast<unsigned long long>(tally.beats),
              static_cast<unsigned long long>(tally.hidden));
  EXPECT_GT(tally.hidden, 100U);
}

// If a cull_block lies between a group's splats, memory has no place that a source could jump over (M-fetch-6).
TEST(CullCycles, FetchedSetsLieTogether) {
  Random random(seed_or(97));
  cmodel::Config config = named_config("tiny");
  config.cull_map = static_cast<int>(cmodel::CullMap::Block);
  int refused = 0, taken = 0;
  for (int i = 0; i < 12; ++i) {
    const auto beats =
        to_beats(random_stream(symbols_of(config), random, 100, i % 2 == 0 ? SetOrder::Any : SetOrder::Whole).bytes);
    Collector seen;
    cmodel::CullLog log;
    cmodel::Model model(config, cmodel::StreamScope::Whole, seen);
    model.log_culls(&log);
    model.consume(beats);
    cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {.culls = &log, .fetch = cmodel::Fetch{3}});
    const auto what = [](const auto& run) -> std::string {
      try {
        run();
        return "";
      } catch (const UserError& error) {
        return error.what();
      }
    };
    const std::string counted = what([&] { cycles.consume(beats); });
    EXPECT_EQ(counted, what([&] { cmodel::fetch_commands(config, beats, 0); }));
    (counted.empty() ? taken : refused) += 1;
    EXPECT_TRUE(counted.empty() || (i % 2 == 0 && counted.find("between the splats of a group") != std::string::npos))
        << counted;
  }
  std::printf("[figure] streams taken by a fetching source = %d, refused = %d\n", taken, refused);
  EXPECT_GT(taken, 0);
  EXPECT_GT(refused, 0);
}

// Commands, executed by hand: every beat once, in order, and the splats of each group (M-fetch-1, M-fetch-2).
TEST(FetchCommands, AreTheStream) {
  Random random(seed_or(98));
  std::uint64_t commands = 0, sets = 0, splats = 0;
  for (const char* name : {"tiny", "small", "ellipse"}) {
    for (const auto map : {cmodel::CullMap::Off, cmodel::CullMap::Block}) {
      cmodel::Config config = named_config(name);
      config.cull_map = static_cast<int>(map);
      const auto beats = to_beats(random_stream(symbols_of(config), random, 300, SetOrder::Whole).bytes);
      constexpr std::uint64_t kFrom = 0x1'0000'0fe0;
      const auto list = cmodel::fetch_commands(config, beats, kFrom);
      if (map == cmodel::CullMap::Off) {
        EXPECT_EQ(list.size(), 1U);
      }
      std::uint64_t next = kFrom;
      for (const cmodel::FetchCommand& command : list) {
        EXPECT_EQ(command.address, next);
        next += (std::uint64_t{command.beats} + command.splats) * cmodel::kBeatBytes;
        const std::size_t from = (command.address - kFrom) / cmodel::kBeatBytes;
        std::uint64_t announced = 0;
        for (std::size_t i = from + command.beats - command.sets; i < from + command.beats; ++i) {
          EXPECT_EQ(beats[i][0] & 0xFF, static_cast<std::uint32_t>(cmodel::Opcode::CullBlock));
          announced += beats[i][5];
        }
        if (command.splats > 0) {
          EXPECT_EQ(announced, command.splats);
        }
        ++commands, sets += command.sets, splats += command.splats;
      }
      EXPECT_EQ(next, kFrom + beats.size() * cmodel::kBeatBytes);
    }
  }
  std::printf("[figure] commands = %llu, sets = %llu, splats in sets = %llu\n",
              static_cast<unsigned long long>(commands), static_cast<unsigned long long>(sets),
              static_cast<unsigned long long>(splats));
  EXPECT_GT(sets, 100U);
  EXPECT_GT(splats, 100U);
}

// M-cull-2: other verdicts, other times; all else in the stream is the same.
TEST(CullCycles, FollowFromTheLogAlone) {
  Random random(seed_or(96));
  cmodel::Config config = named_config("small");
  config.cull_map = static_cast<int>(cmodel::CullMap::Block);
  const auto beats = to_beats(random_stream(symbols_of(config), random, 300).bytes);
  Collector seen;
  cmodel::CullLog log, empty;
  cmodel::Model model(config, cmodel::StreamScope::Whole, seen);
  model.log_culls(&log);
  model.consume(beats);
  const auto busy = [&](const cmodel::CullLog* culls) {
    cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {.culls = culls});
    cycles.consume(beats);
    cycles.finish();
    return cycles.stalls().busy;
  };
  EXPECT_LT(busy(&log), busy(nullptr)) << "nothing is hidden without a log";
  EXPECT_ANY_THROW(busy(&empty)) << "a log of another stream";
  cmodel::CullLog more = log;
  more.tile(0).add(true);
  EXPECT_ANY_THROW(busy(&more)) << "a log with answers that nobody asked for";
}

}  // namespace
}  // namespace fastsplat::test
