// SPDX-License-Identifier: Apache-2.0
// The cycle model's accounts against cycles of events: accounts sum to the busy cycles, pictures take their beats, each
// event has a tap. Accounts of several devices add up kind by kind.
#include <gtest/gtest.h>

#include <cstdio>
#include <iterator>
#include <utility>

#include "cmodel/cycles/cycle_model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

struct Counted final : cmodel::TapSink {
  std::array<std::uint64_t, cmodel::kTapCount> taps{};
  void on_tap(const cmodel::TapRecord& record) override { ++taps[static_cast<std::size_t>(record.tap)]; }
  std::uint64_t of(cmodel::Tap tap) const { return taps[static_cast<std::size_t>(tap)]; }
};

TEST(CycleAccount, OfRunsIsThatOfTheirRecords) {
  constexpr std::uint64_t kFill = 2;  // of pixel out (M-account-4)
  Random random(seed_or(5));
  std::uint64_t tiles = 0, splats = 0;
  for (const char* name : {"tiny", "small", "base"}) {
    const cmodel::Config config = named_config(name);
    for (int i = 0; i < 4; ++i) {
      const auto beats = to_beats(random_stream(symbols_of(config), random, 200).bytes);
      std::uint64_t pictures = 0, pixels = 0;
      for (std::size_t at = 0; at < beats.size(); ++at) {
        const auto opcode = static_cast<cmodel::Opcode>(get(beats[at], cmodel::layout::kOpcode));
        if (opcode == cmodel::Opcode::LoadTable) at += cmodel::announced_beats(beats[at]);
        if (opcode != cmodel::Opcode::BeginTile) continue;
        const auto tile = std::get<cmodel::BeginTile>(cmodel::from_beat(beats[at]));
        const int a_row = (tile.width + config.lanes - 1) / config.lanes;  // M-pixel-1
        pictures += kFill + static_cast<std::uint64_t>(a_row) * static_cast<std::uint64_t>(tile.height);
        pixels += static_cast<std::uint64_t>(tile.width) * static_cast<std::uint64_t>(tile.height);
        ++tiles;
      }
      Counted counted;
      cmodel::CycleModel model(config, cmodel::StreamScope::Whole, {.taps = &counted});
      model.consume(beats);
      model.finish();
      EXPECT_EQ(model.account().pixels, pictures);
      EXPECT_EQ(model.account().output, 0u) << "the sink is always ready";
      EXPECT_EQ(model.account().total(), model.stalls().busy);  // M-account-2
      EXPECT_EQ(counted.of(cmodel::Tap::Snap), model.counters().splats);
      EXPECT_EQ(counted.of(cmodel::Tap::Footprint), model.counters().windows);
      EXPECT_EQ(counted.of(cmodel::Tap::Sheet), model.counters().windows);
      EXPECT_EQ(counted.of(cmodel::Tap::Composite), model.counters().dirty_blocks);
      EXPECT_EQ(counted.of(cmodel::Tap::Pixel), pixels);
      splats += model.counters().splats;
    }
  }
  std::printf("[figure] tiles = %llu, splats = %llu (limits > 12, > 100)\n", static_cast<unsigned long long>(tiles),
              static_cast<unsigned long long>(splats));
  EXPECT_GT(tiles, 12u);
  EXPECT_GT(splats, 100u);
}

// M-account-5, M-cull-17: the exposed part of a walk is subtracted from the waits in their order.
TEST(CycleAccount, ExposedSlicesAreTakenOutOfWaitsInTheirOrder) {
  using cmodel::Pause, cmodel::CycleAccount;
  constexpr std::pair<Pause, std::uint64_t CycleAccount::*> kOrder[] = {{Pause::Buffer, &CycleAccount::sheet_buffer},
                                                                        {Pause::Drain, &CycleAccount::drain},
                                                                        {Pause::Map, &CycleAccount::map},
                                                                        {Pause::Input, &CycleAccount::input},
                                                                        {Pause::Hidden, &CycleAccount::hidden},
                                                                        {Pause::Records, &CycleAccount::records}};
  constexpr std::size_t kWaits = std::size(kOrder);
  for (std::size_t exposed = 0; exposed <= kWaits; ++exposed) {
    cmodel::Accountant accountant;
    accountant.sheet(0, 0, 10, 10 + kWaits);
    accountant.sheet(1, kWaits - exposed, 0, 0);
    // One cycle each, while the first sheet is walked; in an order other than the one that counts.
    for (std::size_t i = 0; i < kWaits; ++i) accountant.pause(kOrder[kWaits - 1 - i].first, 10 + i, 11 + i);
    accountant.settle(0);
    const CycleAccount account = accountant.account();
    EXPECT_EQ(account.ideal, kWaits);
    for (std::size_t i = 0; i < kWaits; ++i)
      EXPECT_EQ(account.*kOrder[i].second, i < exposed ? 0u : 1u) << exposed << ", " << i;
  }
  std::printf("[figure] exposed slices tried = 0 to %zu\n", kWaits);
}

TEST(CycleAccount, AddsUpKindByKind) {
  cmodel::CycleAccount a, b;
  std::uint64_t value = 0;
#define X(name, meaning) a.name = ++value, b.name = 100 * value;
  FASTSPLAT_CYCLE_KINDS(X)
#undef X
  a += b;
  std::uint64_t kind = 0;
  a.for_each([&](const char* name, std::uint64_t sum, const char*) { EXPECT_EQ(sum, 101 * ++kind) << name; });
  EXPECT_EQ(kind, value);
  EXPECT_EQ(a.total(), 101 * value * (value + 1) / 2);
}

}  // namespace
}  // namespace fastsplat::test
