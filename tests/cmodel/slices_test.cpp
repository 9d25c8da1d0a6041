// SPDX-License-Identifier: Apache-2.0
// composite.lanes and counters.bits affect time and registers only: no word of any tap depends on them. Their effect on
// time is the page's rule (docs/microarchitecture.md, M-slices-1 and M-walk-4).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

constexpr std::uint64_t kSeed = 15;
constexpr const char* kConfigs[] = {"tiny", "small", "base", "faults/mustfail"};

/// `name` with C pixels composited at once; 0: all of a block.
cmodel::Config with_lanes(const char* name, int at_once) {
  cmodel::Config config = named_config(name);
  config.composite_lanes = at_once;
  return config;
}

/// The same records for every C: only the hash in begin_frame, hence the checksum, differs.
std::vector<cmodel::Beat> records(const cmodel::Config& config) {
  Random random(kSeed);
  return to_beats(random_stream(symbols_of(config), random, 300).bytes);
}

struct Words final : cmodel::TapSink {
  std::vector<std::uint32_t> words;
  void on_tap(const cmodel::TapRecord& record) override {
    words.insert(words.end(), {static_cast<std::uint32_t>(record.tap), record.tile, record.sheet, record.tag,
                               static_cast<std::uint32_t>(record.x), static_cast<std::uint32_t>(record.y)});
    words.insert(words.end(), record.payload.begin(), record.payload.end());
  }
};

TEST(Slices, NoWordDependsOnHowManyPixelsAreCompositedAtOnce) {
  std::uint64_t compared = 0;
  int configs = 0;
  for (const char* name : kConfigs) {
    Words whole;
    const int block = named_config(name).lanes * named_config(name).lanes;
    for (int at_once = 0; at_once <= block; at_once = std::max(1, 2 * at_once)) {
      const cmodel::Config config = with_lanes(name, at_once);
      ASSERT_FALSE(cmodel::first_violation(config));
      Words sliced;
      cmodel::NullPixels pixels;
      cmodel::Model model(config, cmodel::StreamScope::Whole, pixels, &sliced);
      model.consume(records(config));
      model.finish();
      if (at_once == 0) whole = sliced;
      EXPECT_EQ(sliced.words == whole.words, true) << name << ", " << at_once << " at once";
      compared += sliced.words.size();
      ++configs;
    }
  }
  std::printf("[figure] words that are the same for every C = %llu, of %d configurations\n",
              static_cast<unsigned long long>(compared), configs);
  EXPECT_EQ(configs, 4 + 6 + 8 + 6);
}

/// The length of a sheet's walk by the page's rule, and the cycles of its composite taps by its slices.
struct Walk final : cmodel::CycleSink, cmodel::TapSink {
  explicit Walk(std::uint64_t slices, std::uint64_t way) : slices_(slices), way_(way) {}
  void on_tap(const cmodel::TapRecord& record) override {
    if (record.tap == cmodel::Tap::Composite) taps_.push_back(record.cycle);
  }
  void on_sheet(const cmodel::SheetCycles& sheet) override {
    sheets_.push_back(sheet);
    // M-walk-4, with R cycles a block (M-walk-3, M-slices-1)
    const std::uint64_t first = std::max(sheet.closed + way_, last_ == 0 ? 0 : last_ + 4);
    last_ = first + std::max<std::uint64_t>(sheet.blocks * slices_, 1) - 1;
    wrong += sheet.walk_from != first || sheet.walk_to != last_ + 1 ? 1 : 0;
    for (std::uint64_t block = 0; block < sheet.blocks; ++block)
      expected_.push_back(first + block * slices_ + slices_ - 1 + 6);  // M-pipe-1
  }
  void on_tile(const cmodel::TileCycles&) override {}
  bool taps_in_time() const { return taps_ == expected_; }
  std::size_t taps() const { return taps_.size(); }

  int wrong = 0;

 private:
  std::uint64_t slices_, way_, last_ = 0;
  std::vector<cmodel::SheetCycles> sheets_;
  std::vector<std::uint64_t> taps_, expected_;
};

TEST(Slices, ABlockTakesAsManyCyclesAsItHasSlices) {
  std::size_t taps = 0;
  for (const char* name : kConfigs) {
    const int block = named_config(name).lanes * named_config(name).lanes;
    std::uint64_t busy_before = 0;
    for (int at_once = block; at_once >= 1; at_once /= 2) {
      const cmodel::Config config = with_lanes(name, at_once);
      Walk walk(static_cast<std::uint64_t>(block / at_once), config.has_ellipses() ? 22 : 12);
      cmodel::CycleModel model(config, cmodel::StreamScope::Whole, {.taps = &walk, .spans = &walk});
      model.consume(records(config));
      model.finish();
      EXPECT_EQ(walk.wrong, 0) << name << ", " << at_once << " at once: sheets walked out of time";
      EXPECT_TRUE(walk.taps_in_time()) << name << ", " << at_once << " at once";
      EXPECT_EQ(model.account().total(), model.stalls().busy);
      EXPECT_GT(model.stalls().busy, busy_before) << name << ": fewer lanes are slower";
      busy_before = model.stalls().busy;
      taps += walk.taps();
    }
  }
  std::printf("[figure] composite taps in their cycle = %zu (limit > 0)\n", taps);
  EXPECT_GT(taps, 0U);
}

// N-9-7, M-register-11
TEST(Counters, ARegisterShowsACountModuloItsWidth) {
  cmodel::Config config = named_config("tiny");
  const std::uint64_t count = 0xfedcba9876543210U;
  EXPECT_EQ(config.counter_word(count), count);
  config.counter_bits = 16;
  EXPECT_EQ(config.counter_word(count), 0x3210U);
  EXPECT_EQ(config.counter_word(65535), 65535U);
  EXPECT_EQ(config.counter_word(65536), 0U);
  config.counter_bits = 33;
  EXPECT_EQ(config.counter_word(count), 0x076543210U);
}

}  // namespace
}  // namespace fastsplat::test
