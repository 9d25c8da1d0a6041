// SPDX-License-Identifier: Apache-2.0
// The cycle model against the Verilated device: every event's cycle, every cycle counter.
#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/cycles/cycle_model.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/device/rtl_device.hpp"
#include "testbench/device/tap_assembly.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/testbench/cycle_board_helper.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Pattern;

/// begin_frame and tables with which a splat's footprint is exactly P x P: one window a splat.
void begin_one_window_frame(StreamWriter& writer, const cmodel::Config& config) {
  const auto words = [](int count) { return std::vector<std::uint32_t>(static_cast<std::size_t>(count), 1); };
  writer.begin_frame(config.tile_width, config.tile_height, 1);
  const int rho = config.lanes * config.phases / 2;
  writer.load_table(0, 0, static_cast<std::uint32_t>(rho), 0, words(config.lanes * config.phases));
  writer.load_table(1, 0, 0, 0, words(config.radial_entries));
  writer.load_table(2, 0, 0, 0, words(config.opacity_segments + 1));
}

class EachConfig : public ::testing::TestWithParam<std::string> {
 protected:
  cmodel::Config config() const { return driver::load_config(GetParam()); }
};

TEST_P(EachConfig, RandomStreamsUnderPairsOfPatterns) {
  Random random(seed_or(31));
  CycleComparison total;
  const auto patterns = Pattern::examples();
  ASSERT_GE(patterns.size(), 6U);
  int pairs = 0;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    for (std::size_t o = 0; o < patterns.size(); ++o) {
      // The large array is slow to simulate: every pattern thrice on each side here, all pairs in the slow test.
      if (config().lanes >= 8 && (i + o) % 2 != 0) continue;
      const auto seed = ++pairs;
      const auto stream = random_stream(symbols_of(config()), random, config().lanes >= 8 ? 30 : 60);
      total += compare_cycles(config(), to_beats(stream.bytes), Pattern(patterns[i], static_cast<std::uint64_t>(seed)),
                              Pattern(patterns[o], static_cast<std::uint64_t>(seed) + 1000));
      if (total.mismatches > 0) FAIL() << patterns[i] << "/" << patterns[o] << ": " << total.first;
    }
  }
  std::printf("[figure] %s pairs of patterns = %d (limit >= 12)\n", GetParam().c_str(), pairs);
  EXPECT_GE(pairs, 12);
  judge(GetParam() + " random", total);
  total.account.for_each([&](const char* name, std::uint64_t cycles, const char*) {
    const bool of_culling = std::string(name) == "hidden" || std::string(name) == "map";
    if (of_culling && !config().culls()) {
      EXPECT_EQ(cycles, 0U) << name;
    } else {
      EXPECT_GT(cycles, 0U) << name << ": the streams never went that way";
    }
    std::printf("[figure] %s %s = %llu cycles\n", GetParam().c_str(), name, static_cast<unsigned long long>(cycles));
  });
}

TEST_P(EachConfig, ScenesOfEveryMethod) {
  CycleComparison total;
  const auto patterns = Pattern::examples();
  std::size_t turn = 0;
  for (const auto method : {scene::Method::ImageAligned, scene::Method::AxisAligned, scene::Method::XRay}) {
    for (const int half_slabs : {1, 2, 4}) {
      if (half_slabs != 2 && method != scene::Method::ImageAligned) continue;
      scene::SceneDescription description;
      description.volume = "shells:8";
      description.width = 36;
      description.height = 33;
      description.method = method;
      description.slab_width = half_slabs / 2.0;
      const auto beats = scene_beats(description, config());
      const std::string& input = patterns[turn % patterns.size()];
      const std::string& output = patterns[(turn * 5 + 1) % patterns.size()];
      ++turn;
      total += compare_cycles(config(), beats, Pattern(), Pattern());
      total += compare_cycles(config(), beats, Pattern(input, turn), Pattern(output, turn));
    }
  }
  judge(GetParam() + " scenes", total);
}

TEST_P(EachConfig, IdenticalCentresTakeOneCycleEach) {
  constexpr int kSplats = 500;
  StreamWriter writer(symbols_of(config()));
  begin_one_window_frame(writer, config());
  writer.begin_tile(0, 0, 0, 0, config().tile_width, config().tile_height);
  writer.begin_sheet(0);
  const std::int32_t centre = (config().tile_width / 2) << config().position_frac_bits;
  for (int i = 0; i < kSplats; ++i) writer.splat(0, centre, centre, {9, 9, 9, 9});
  writer.end_sheet();
  writer.end_tile();
  writer.end_frame();

  // Cycles of the first and the last sum written, from the RTL's own taps.
  struct Span final : cmodel::TapSink {
    std::uint64_t first = 0, last = 0, count = 0;
    void on_tap(const cmodel::TapRecord& record) override {
      if (record.tap != cmodel::Tap::Sheet) return;
      if (count++ == 0) first = record.cycle;
      last = record.cycle;
    }
  } rtl_span, model_span;
  cmodel::NullPixels pixels;
  testbench::RtlOptions options;
  testbench::TapAssembly taps(config(), pixels, rtl_span);
  options.taps = &taps;
  const auto beats = to_beats(writer.bytes());
  const auto rtl = testbench::make_rtl_device(config(), pixels, options);
  rtl->consume(beats);
  rtl->finish();
  cmodel::CycleModel model(config(), cmodel::StreamScope::Whole,
                           {.input = nullptr, .output = nullptr, .first_beat = 4, .taps = &model_span});
  model.consume(beats);
  model.finish();
  for (const Span& span : {rtl_span, model_span}) {
    ASSERT_EQ(span.count, static_cast<std::uint64_t>(kSplats));
    EXPECT_EQ(span.last - span.first + 1, span.count);  // a window a cycle at one place (M-path-1, M-forward-3)
  }
  // Frame, tables, then the formula of a tile that never waits for a buffer (M-account-6).
  const auto table_words = static_cast<std::uint64_t>(config().lanes) * static_cast<std::uint64_t>(config().phases) +
                           static_cast<std::uint64_t>(config().radial_entries) +
                           static_cast<std::uint64_t>(config().opacity_segments) + 1;
  const auto beats_out = static_cast<std::uint64_t>(config().tile_width / config().lanes) *
                         static_cast<std::uint64_t>(config().tile_height);
  const std::uint64_t picks = model.counters().dirty_blocks * static_cast<std::uint64_t>(config().slices());
  const std::uint64_t by_hand = 1 + 3 + table_words + 1 + (kSplats + 2) + (picks + 18) + (2 + beats_out);
  std::printf("[figure] %s busy cycles = %llu, by hand %llu\n", GetParam().c_str(),
              static_cast<unsigned long long>(model.stalls().busy), static_cast<unsigned long long>(by_hand));
  EXPECT_EQ(model.stalls().busy, by_hand);
  EXPECT_EQ(rtl->cycle_counters().busy, by_hand);  // M-account-1
  EXPECT_EQ(model.account().drain, 17U);  // M-account-4

  const double rate = static_cast<double>(rtl_span.count) / static_cast<double>(rtl_span.last - rtl_span.first + 1);
  std::printf("[figure] %s windows per cycle at identical centres = %.3f (limit 1.000)\n", GetParam().c_str(), rate);
  RecordProperty("windows_per_cycle", std::to_string(rate));
}

// The number of windows from which a sheet's begin_sheet never waits for a buffer (M-account-6).
TEST_P(EachConfig, SheetsOfNineWindowsMoreThanBlocksNeverWait) {
  constexpr std::uint64_t kSheets = 6;
  const std::int32_t centre = (config().tile_width / 2) << config().position_frac_bits;
  const auto run = [&](std::uint64_t splats) {
    StreamWriter writer(symbols_of(config()));
    begin_one_window_frame(writer, config());
    writer.begin_tile(0, 0, 0, 0, config().tile_width, config().tile_height);
    for (std::uint32_t sheet = 0; sheet < kSheets; ++sheet) {
      writer.begin_sheet(sheet);
      for (std::uint64_t i = 0; i < splats; ++i) writer.splat(0, centre, centre, {9, 9, 9, 9});
      writer.end_sheet();
    }
    writer.end_tile();
    writer.end_frame();
    return compare_cycles(config(), to_beats(writer.bytes()), Pattern(), Pattern());
  };
  const std::uint64_t blocks =
      run(1).counters.dirty_blocks / kSheets * static_cast<std::uint64_t>(config().slices());  // a slice a cycle
  const auto enough = run(blocks + 9), short_of_one = run(blocks + 8);
  std::printf("[figure] %s sheets of %llu blocks: waits for a buffer %llu (limit 0), with one window less %llu\n",
              GetParam().c_str(), static_cast<unsigned long long>(blocks),
              static_cast<unsigned long long>(enough.stalls.stall_buffer),
              static_cast<unsigned long long>(short_of_one.stalls.stall_buffer));
  EXPECT_EQ(enough.mismatches + short_of_one.mismatches, 0U) << enough.first << short_of_one.first;
  // begin_sheet of s+2 waits until the last block of s was picked, and no longer (M-decode-5, M-pipe-2).
  EXPECT_EQ(enough.stalls.stall_buffer, 0U);
  EXPECT_GT(short_of_one.stalls.stall_buffer, 0U);
}

INSTANTIATE_TEST_SUITE_P(Rtl, EachConfig, ::testing::Values("tiny", "small", "base"),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace fastsplat::test
