// SPDX-License-Identifier: Apache-2.0
// The fetch master (docs/microarchitecture.md, "Fetch"): the right beats under any memory, no set asked for that is
// hidden or undecided, every cycle if the memory is regular, errors reported; and each planted fault seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/fetch/fetch_bench_helper.hpp"
#include "tests/fetch/stops_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

constexpr unsigned kResponse = 1, kVerdict = 2, kCommand = 3;  ///< errors
constexpr std::uint32_t kMostSets = 1024;                      ///< of a command: 2^SETS_LOG2
constexpr unsigned kLatencies[] = {1, 7, 40, 45};              ///< the last: all that 64 beats of room hide

FetchStream stream_of(const char* name, std::uint64_t seed, std::uint64_t splats,
                      cmodel::CullMap map = cmodel::CullMap::Block) {
  Random random(seed);
  cmodel::Config config = named_config(name);
  config.cull_map = static_cast<int>(map);
  return fetch_stream(config, to_beats(random_stream(symbols_of(config), random, splats, SetOrder::Whole).bytes),
                      kAddress);
}

/// For each of `empties` a sheet of so many sets without splats, in front of one whose sets have 2, 0, 2 and 2.
FetchStream stream_with_empty_sets(const std::vector<int>& empties) {
  cmodel::Config config = named_config("tiny");
  config.cull_map = static_cast<int>(cmodel::CullMap::Block);
  StreamWriter w(symbols_of(config));
  w.begin_frame(16, 16, 1);
  w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), 1));
  w.load_table(2, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1, 1));
  const auto words = static_cast<std::size_t>(config.lanes) * static_cast<std::size_t>(config.phases);
  w.load_table(0, 0, static_cast<std::uint32_t>(words / 2), 0, std::vector<std::uint32_t>(words, 0));
  w.begin_tile(0, 0, 0, 0, 16, 16);
  std::uint32_t sheet = 0;
  for (const int empty : empties) {
    w.begin_sheet(sheet++);
    for (int i = 0; i < empty; ++i) w.cull_block(w.next_tag(), 0, 0, 16, 16, 0);
    w.end_sheet();
    w.begin_sheet(sheet++);
    for (std::uint32_t i = 0; i < 3; ++i) {
      w.cull_block(w.next_tag() + 2 * i, 0, 0, 16, 16, 2);
      if (i == 0) w.cull_block(w.next_tag() + 2, 0, 0, 16, 16, 0);
    }
    for (int i = 0; i < 6; ++i)
      w.splat(0, 8 << config.position_frac_bits, 8 << config.position_frac_bits, {1, 1, 1, 1});
    w.end_sheet();
  }
  w.end_tile();
  w.end_frame();
  return fetch_stream(config, to_beats(w.bytes()), kAddress);
}

/// What the page says of when beats are offered, from the cycles in which those before were taken: M-fetch-8, the sums
/// of M-fetch-7.
std::vector<std::uint64_t> due(const FetchStream& stream, const FetchResult& seen, std::uint64_t latency) {
  std::vector<std::uint64_t> out;
  int last_block = -1, before = -1;  // of those passed; the set of the beat before, sent or not
  std::size_t sent = 0;
  for (std::size_t i = 0; i < stream.beats.size(); ++i) {
    const int set = stream.set_of[i];
    const bool trusted = set >= 0 && stream.trusted[static_cast<std::size_t>(set)];
    // M-fetch-4, M-fetch-5
    const int waits = trusted ? -1 : set >= 0 ? set : before >= 0 ? last_block : -1;
    before = set;
    if (stream.block[i] >= 0) last_block = stream.block[i];
    if (set >= 0 && !trusted && stream.hidden[static_cast<std::size_t>(set)]) continue;
    std::uint64_t cycle = sent == 0 ? seen.begun + latency + 4 : seen.taken[sent - 1] + 1;
    if (waits >= 0) cycle = std::max(cycle, seen.verdicts[static_cast<std::size_t>(waits)] + latency + 6);
    out.push_back(cycle);
    ++sent;
  }
  return out;
}

// M-fetch-7, M-fetch-8; RREADY never keeps a beat back (M-fetch-14).
TEST(Fetch, IsExactWhereTheMemoryIsRegular) {
  std::uint64_t beats = 0, unsent = 0, waited = 0;
  for (const char* name : {"tiny", "small"}) {
    for (const unsigned latency : kLatencies) {
      for (const char* ready : {"always", "random-70", "burst-40", "every-3"}) {
        const FetchStream stream = stream_of(name, 7 * latency + beats, 200);
        const FetchRun run{
            .memory = {.latency = latency}, .ready = Pattern(ready, latency), .verdict_wait = latency == 7 ? 30U : 0U};
        const FetchResult seen = run_fetch(stream, run);
        ASSERT_EQ(seen.finding, "") << name << ", latency " << latency << ", ready " << ready;
        ASSERT_TRUE(seen.all_sent);
        const auto times = due(stream, seen, latency);
        ASSERT_EQ(times.size(), seen.offered.size());
        for (std::size_t i = 0; i < times.size(); ++i) {
          ASSERT_EQ(seen.offered[i], times[i])
              << "beat " << i << " sent, " << name << ", latency " << latency << ", " << ready;
          waited += i > 0 && times[i] > seen.taken[i - 1] + 1 ? 1 : 0;
        }
        beats += times.size();
        unsent += stream.beats.size() - times.size();
      }
    }
  }
  std::printf("[figure] beats offered in their cycle = %llu, waits = %llu, beats of hidden sets = %llu\n",
              static_cast<unsigned long long>(beats), static_cast<unsigned long long>(waited),
              static_cast<unsigned long long>(unsent));
  EXPECT_GT(unsent, 100U);
  EXPECT_GT(waited, 100U);
}

// Beyond that requests wait for room: the same beats, later (M-fetch-9).
TEST(Fetch, IsLateWhereThereIsNoRoomForTheLatency) {
  const FetchStream stream = stream_of("tiny", 11, 600, cmodel::CullMap::Off);
  for (const unsigned latency : {45U, 60U}) {
    const FetchResult seen = run_fetch(stream, {.memory = {.latency = latency}});
    ASSERT_EQ(seen.finding, "");
    ASSERT_TRUE(seen.all_sent);
    const auto times = due(stream, seen, latency);
    std::uint64_t late = 0;
    for (std::size_t i = 0; i < times.size(); ++i) late += seen.offered[i] - times[i];
    std::printf("[figure] latency %u: cycles late = %llu of %llu\n", latency, static_cast<unsigned long long>(late),
                static_cast<unsigned long long>(seen.cycles));
    EXPECT_EQ(late == 0, latency == 45);
  }
}

// M-fetch-11
TEST(Fetch, SendsTheSameBeatsFromAnyMemory) {
  std::uint64_t beats = 0, unsent = 0, bursts = 0, cycles = 0;
  std::size_t under_way = 0;
  for (int i = 0; i < 48; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const auto pattern = [&](const std::vector<const char*>& of, std::uint64_t salt) {
      return Pattern(of[testbench::mix(seed + 1000 * salt) % of.size()], seed + salt);
    };
    const FetchStream stream = stream_of(i % 3 == 0 ? "small" : "tiny", 300 + seed, 150,
                                         i % 8 == 7 ? cmodel::CullMap::Off : cmodel::CullMap::Pixel);
    const FetchRun run{.build = i % 2 == 0 ? FetchBuild::Default : FetchBuild::Narrow,
                       .memory = {.latency = kLatencies[seed % 4],
                                  .more_latency = static_cast<unsigned>(seed % 5 * 20),
                                  .takes = pattern({"always", "random-30", "burst-60"}, 1),
                                  .has = pattern({"always", "random-60", "burst-25", "every-4"}, 2),
                                  .seed = seed},
                       .shy = i % 5 == 0,
                       .ready = pattern({"always", "random-50", "burst-90", "alternate-7"}, 3),
                       .commands = pattern({"always", "random-10", "every-300"}, 4),
                       .verdict_wait = static_cast<unsigned>(seed % 3 * 15),
                       .seed = seed};
    const FetchResult seen = run_fetch(stream, run);
    ASSERT_EQ(seen.finding, "") << "run " << i;
    ASSERT_TRUE(seen.all_sent) << "run " << i;
    beats += seen.taken.size(), unsent += stream.beats.size() - seen.taken.size();
    bursts += seen.bursts, cycles += seen.cycles;
    under_way = std::max(under_way, seen.most_under_way);
  }
  std::printf(
      "[figure] beats sent = %llu, of hidden sets and never asked for = %llu, bursts = %llu, most under way = %zu, "
      "cycles = %llu\n",
      static_cast<unsigned long long>(beats), static_cast<unsigned long long>(unsent),
      static_cast<unsigned long long>(bursts), under_way, static_cast<unsigned long long>(cycles));
  EXPECT_GT(unsent, 100U);
  EXPECT_GT(under_way, 2U);
}

struct WrongCommand {
  const char* what;
  void (*spoil)(cmodel::FetchCommand&);
};
const WrongCommand kWrongCommands[] = {
    {"address + 1", [](cmodel::FetchCommand& c) { c.address += 1; }},
    {"address + 2", [](cmodel::FetchCommand& c) { c.address += 2; }},
    {"address + 4", [](cmodel::FetchCommand& c) { c.address += 4; }},
    {"address + 8", [](cmodel::FetchCommand& c) { c.address += 8; }},
    {"address + 16", [](cmodel::FetchCommand& c) { c.address += 16; }},
    {"long address, bit 40", [](cmodel::FetchCommand& c) { c.address |= std::uint64_t{1} << 40; }},
    {"long address, bit 63", [](cmodel::FetchCommand& c) { c.address |= std::uint64_t{1} << 63; }},
    {"no beats", [](cmodel::FetchCommand& c) { c.beats = c.sets = c.splats = 0; }},
    {"more sets than beats", [](cmodel::FetchCommand& c) { c.sets = c.beats + 1; }},
    {"more sets than 2^SETS_LOG2", [](cmodel::FetchCommand& c) { c.beats = c.sets = kMostSets + 1; }},
    {"splats without sets", [](cmodel::FetchCommand& c) { c.sets = 0, c.splats = 1; }},
};

// Each error (M-fetch-17); commands that break M-fetch-1.
TEST(Fetch, ReportsErrorsAndStops) {
  const FetchStream stream = stream_of("tiny", 5, 200);
  int told = 0;
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    for (const std::size_t number : {std::size_t{0}, std::size_t{9}, stream.wanted().size() - 1}) {
      FetchRun run{.build = build, .memory = {.latency = 5}};
      run.spoiled = stream.wanted()[number];
      run.error = kResponse;
      const FetchResult seen = run_fetch(stream, run);
      EXPECT_EQ(seen.finding, "");
      EXPECT_EQ(seen.taken.size(), number) << "what came before it is sent";  // M-fetch-18
      ++told;
    }
    for (const int set : {0, 3}) {
      FetchRun run{.build = build, .memory = {.latency = 5}};
      run.other_tag = set, run.other_by = set == 0 ? 1 : ~0U;
      run.error = kVerdict;
      const FetchResult seen = run_fetch(stream, run);
      EXPECT_EQ(seen.finding, "");
      EXPECT_FALSE(seen.all_sent);
      ++told;
    }
    for (const auto& [what, spoil] : kWrongCommands) {
      if (build == FetchBuild::Default && std::string(what).starts_with("long")) continue;  // takes 64 bits
      FetchStream wrong = stream;
      spoil(wrong.commands[0]);
      const FetchResult seen = run_fetch(wrong, {.build = build, .error = kCommand});
      EXPECT_EQ(seen.finding, "") << what;
      EXPECT_EQ(seen.bursts, 0U) << what;
      ++told;
    }
  }
  std::printf("[figure] errors told = %d\n", told);
}

// M-fetch-19, step 1.
TEST(Fetch, StopsAnywhere) {
  const FetchStream stream = stream_of("tiny", 6, 200);
  std::uint64_t sent = 0;
  int stops = 0;
  for (std::size_t after = 1; after < stream.wanted().size(); after += 17) {
    FetchRun run{.build = after % 2 == 0 ? FetchBuild::Default : FetchBuild::Narrow,
                 .memory = {.latency = 9, .has = Pattern("random-60", after)},
                 .ready = Pattern("random-60", after)};
    run.stop_after = after;
    const FetchResult seen = run_fetch(stream, run);
    EXPECT_EQ(seen.finding, "");
    EXPECT_GE(seen.taken.size(), after);
    EXPECT_EQ(seen.taken.size(), seen.asked) << "all that was asked for is sent";
    sent += seen.taken.size();
    ++stops;
  }
  std::printf("[figure] stops = %d, beats sent = %llu\n", stops, static_cast<unsigned long long>(sent));
  EXPECT_GT(stops, 10);
}

// Errors of two kinds in one frame: what is sent has no hole, whichever comes first (M-fetch-18).
TEST(Fetch, SendsNothingBehindABeatThatCannotBeRead) {
  const FetchStream stream = stream_of("tiny", 5, 200);
  const std::size_t wanted = stream.wanted().size();
  int runs = 0, both = 0;
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    for (const int set : {0, 1, 2, 3}) {
      for (std::size_t number = 0; number < wanted; number += 2) {
        FetchRun run{.build = build, .memory = {.latency = 5}, .ready = Pattern("random-60", number)};
        run.other_tag = set, run.spoiled = stream.wanted()[number], run.any_error = true;
        const FetchResult seen = run_fetch(stream, run);
        ASSERT_EQ(seen.finding, "") << "set " << set << ", beat " << number;
        ASSERT_NE(seen.error, 0U);
        ASSERT_LE(seen.taken.size(), number);
        ++runs;
        both += seen.error == kVerdict && seen.asked > number ? 1 : 0;
      }
    }
  }
  std::printf("[figure] runs with two errors = %d, unreadable beat behind a wrong verdict = %d\n", runs, both);
  EXPECT_GT(both, 5);
}

// M-fetch-19, M-fetch-20, M-fetch-21
TEST(Fetch, WorksAgainAfterAStop) {
  std::uint64_t runs = 0;
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    FetchRun run{
        .build = build, .memory = {.latency = 9, .has = Pattern("random-60", 5)}, .ready = Pattern("random-60", 3)};
    run.verdict_wait = 12;
    Stops stops = stop_and_begin_again(stream_of("tiny", 6, 60), run, 97);
    EXPECT_EQ(stops.finding, "");
    runs += stops.runs;
    // With more sets on their way than the master keeps in mind: verdicts come during `stop` that match nothing.
    run.memory.latency = 3, run.ahead = 60, run.verdict_wait = 30;
    stops = stop_and_begin_again(stream_with_empty_sets({30, 7, 40}), run, 13);
    EXPECT_EQ(stops.finding, "");
    runs += stops.runs;
    // And while it has more such sets to send.
    run.ahead = 30;
    stops = stop_and_begin_again(stream_with_empty_sets({100}), run, 13);
    EXPECT_EQ(stops.finding, "");
    runs += stops.runs;
    // And while beats are still to be sent.
    run.ahead = 60, run.ready = Pattern("every-30", 3), run.verdict_wait = 400;
    stops = stop_and_begin_again(stream_with_empty_sets({30, 7, 40}), run, 97);
    EXPECT_EQ(stops.finding, "");
    runs += stops.runs;
  }
  std::printf("[figure] stops with a whole frame after them = %llu\n", static_cast<unsigned long long>(runs));
  EXPECT_GT(runs, 50U);
}

// The device gives no verdict any more, and the master has sets to send: M-fetch-19, M-fetch-22.
TEST(Fetch, WorksAgainAfterARefusal) {
  const FetchStream stream = stream_with_empty_sets({30, 7, 40});
  std::uint64_t runs = 0, full = 0;
  for (const std::size_t judged : {0U, 3U, 20U, 38U}) {
    for (std::uint64_t stop = 20; stop < 1200; stop += 25) {
      FetchRun run{.build = FetchBuild::Narrow, .memory = {.latency = 3}};
      run.ahead = 60, run.mute = judged, run.again = true, run.stop_at = stop;
      const FetchResult seen = run_fetch(stream, run);
      ASSERT_EQ(seen.finding, "") << judged << " judged, stop in cycle " << stop;
      ASSERT_TRUE(seen.stopped && seen.all_sent);
      ++runs;
      full += seen.most_unjudged >= 8 ? 1 : 0;
    }
  }
  std::printf("[figure] refusals = %llu, with as many sets unjudged as there is room for = %llu\n",
              static_cast<unsigned long long>(runs), static_cast<unsigned long long>(full));
  EXPECT_GT(full, 10U);
}

// M-fetch-19
TEST(Fetch, WorksAgainAfterAnyError) {
  const FetchStream stream = stream_of("tiny", 7, 60);
  std::uint64_t runs = 0;
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    for (std::size_t number = 0; number < stream.wanted().size(); ++number) {
      FetchRun run{.build = build, .memory = {.latency = 7}, .ready = Pattern("random-60", number)};
      run.verdict_wait = 12, run.again = true;
      run.spoiled = stream.wanted()[number], run.spoiled_once = true, run.stop_after_error = 1 + number % 40;
      run.error = kResponse;
      const FetchResult seen = run_fetch(stream, run);
      ASSERT_EQ(seen.finding, "") << "beat " << number;
      ASSERT_TRUE(seen.stopped && seen.all_sent);
      ++runs;
    }
  }
  std::printf("[figure] frames sent whole after an error = %llu\n", static_cast<unsigned long long>(runs));
  EXPECT_GT(runs, 100U);
}

// M-fetch-1 where splats is 0, M-fetch-4 behind such a command
TEST(Fetch, VerdictsOfSetsWithoutSplatsChangeNothing) {
  FetchStream stream = stream_with_empty_sets({1, 5, 2, 9});
  for (const bool hides : {false, true}) {
    // Every other set with splats: the next sheet's sets are not trusted, and verdicts of those without splats come
    // while its own are waited for.
    bool hide = false;
    for (std::size_t set = 0; set < stream.hidden.size() && hides; ++set) {
      if (std::ranges::count(stream.set_of, static_cast<int>(set)) > 0) stream.hidden[set] = hide = !hide;
    }
    stream.trust();
    for (const unsigned wait : {0U, 12U, 40U}) {
      FetchRun run{.memory = {.latency = 2}};
      run.verdict_wait = wait;
      const FetchResult seen = run_fetch(stream, run);
      EXPECT_EQ(seen.finding, "") << (hides ? "some hidden" : "none hidden") << ", verdicts wait " << wait;
      EXPECT_TRUE(seen.all_sent);
    }
  }
  std::printf("[figure] sets = %zu, beats = %zu\n", stream.hidden.size(), stream.beats.size());
}

// M-fetch-1
TEST(Fetch, TakesAsManySetsAsACommandMayHave) {
  const FetchStream stream = stream_with_empty_sets({kMostSets});
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    const FetchResult seen = run_fetch(stream, {.build = build, .memory = {.latency = 3}});
    EXPECT_EQ(seen.finding, "");
    EXPECT_TRUE(seen.all_sent);
  }
  std::printf("[figure] sets of a command = %u\n", kMostSets);
}

// More sets than the master keeps in mind lie between it and the verdicts, as behind a FIFO: it waits (M-fetch-16).
TEST(Fetch, WaitsWhileTooManySetsAreUnjudged) {
  std::uint64_t full = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const FetchStream stream = stream_of("small", 40 + seed, 300);
    for (const unsigned ahead : {8U, 18U, 60U}) {
      FetchRun run{.build = seed % 2 == 0 ? FetchBuild::Default : FetchBuild::Narrow, .memory = {.latency = 3}};
      run.ahead = ahead, run.verdict_wait = 30;
      const FetchResult seen = run_fetch(stream, run);
      ASSERT_EQ(seen.finding, "") << "seed " << seed << ", " << ahead << " beats between";
      ASSERT_TRUE(seen.all_sent);
      const std::size_t room = run.build == FetchBuild::Default ? 16 : 8;
      full += seen.most_unjudged == room ? 1 : 0;
      EXPECT_LE(seen.most_unjudged, room);
    }
  }
  std::printf("[figure] runs with as many sets unjudged as there is room for = %llu\n",
              static_cast<unsigned long long>(full));
  EXPECT_GT(full, 0U);
}

// Other beats do not wait for verdicts (M-fetch-8, M-fetch-16).
TEST(Fetch, SendsOtherBeatsWhileTooManySetsAreUnjudged) {
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    const int room = build == FetchBuild::Default ? 16 : 8;
    const FetchStream stream = stream_with_empty_sets({room});
    FetchRun run{.build = build, .memory = {.latency = 1}};
    run.ahead = 60, run.verdict_wait = 400;
    const FetchResult seen = run_fetch(stream, run);
    ASSERT_EQ(seen.finding, "");
    EXPECT_EQ(seen.most_unjudged, static_cast<std::size_t>(room));
    const auto last = std::ranges::find(stream.block, room - 1) - stream.block.begin();
    for (std::ptrdiff_t beat = last + 1; beat < last + 3; ++beat) {  // end_sheet, begin_sheet
      const auto at = static_cast<std::size_t>(beat);
      EXPECT_EQ(seen.offered[at], seen.taken[at - 1] + 1) << beat - last << " behind the last set";
    }
  }
}

// M-fetch-17, error 2
TEST(Fetch, RefusesAVerdictThatNobodyWaitsFor) {
  const FetchStream stream = stream_of("tiny", 5, 200);
  int told = 0;
  for (const std::uint64_t cycle : {1U, 40U, 200U}) {
    FetchRun run{.memory = {.latency = 5}};
    run.stray = cycle, run.error = kVerdict;
    EXPECT_EQ(run_fetch(stream, run).finding, "") << cycle;
    ++told;
  }
  std::printf("[figure] stray verdicts = %d\n", told);
}

struct Planted {
  FetchFault fault;
  const char* name;
  const char* said;
  const char* meaning;
};
const Planted kPlanted[] = {
#define FAULT(name, said, meaning) {FetchFault::name, #name, said, meaning},
#include "tests/fetch/fetch_faults.def"
#undef FAULT
};

class PlantedFetchFault : public ::testing::TestWithParam<Planted> {};

TEST_P(PlantedFetchFault, IsSeen) {
  const Planted& planted = GetParam();
  for (const FetchBuild build : {FetchBuild::Default, FetchBuild::Narrow}) {
    // There is more behind one another than there is room for where no set is waited for.
    const bool all = planted.fault == FetchFault::FETCH_NO_ROOM;
    const FetchStream stream = stream_of("tiny", 5, 200, all ? cmodel::CullMap::Off : cmodel::CullMap::Block);
    FetchRun run{
        .build = build, .memory = {.latency = 12, .takes = Pattern("random-50", 3)}, .ready = Pattern("random-20", 4)};
    if (planted.fault == FetchFault::FETCH_BAD_RESPONSE) run.spoiled = stream.wanted()[30], run.error = kResponse;
    if (planted.fault == FetchFault::FETCH_ANY_TAG) run.other_tag = 2, run.error = kVerdict;
    const std::string healthy = run_fetch(stream, run).finding;
    EXPECT_EQ(healthy, "");
    run.fault = planted.fault;
    const std::string finding = run_fetch(stream, run).finding;
    EXPECT_NE(finding.find(planted.said), std::string::npos) << planted.meaning << ": " << finding;
    std::printf("[figure] %s: %s\n", planted.name, finding.c_str());
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlantedFetchFault, ::testing::ValuesIn(kPlanted),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace fastsplat::test
