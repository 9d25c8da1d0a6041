// SPDX-License-Identifier: Apache-2.0
#include "tests/testbench/cycle_board_helper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <optional>
#include <set>

#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/model.hpp"
#include "testbench/device/rtl_device.hpp"
#include "testbench/device/tap_assembly.hpp"

namespace fastsplat::test {
namespace {

struct Event {
  std::uint32_t tile, sheet, tag;
  std::int32_t x, y;
  std::uint64_t cycle;
  bool operator==(const Event&) const = default;
};

Event event_of(const cmodel::TapRecord& record) {
  return {record.tile, record.sheet, record.tag, record.x, record.y, record.cycle};
}

std::string text_of(const Event& event) {
  return "tile " + std::to_string(event.tile) + " sheet " + std::to_string(event.sheet) + " tag " +
         std::to_string(event.tag) + " (" + std::to_string(event.x) + "," + std::to_string(event.y) + ") cycle " +
         std::to_string(event.cycle);
}

struct Expected final : cmodel::TapSink {
  std::array<std::deque<Event>, cmodel::kTapCount> events;
  void on_tap(const cmodel::TapRecord& record) override {
    events[static_cast<std::size_t>(record.tap)].push_back(event_of(record));
  }
};

struct Checker final : cmodel::TapSink {
  Checker(Expected& from, CycleComparison& into) : expected(from), result(into) {}
  Expected& expected;
  CycleComparison& result;
  void mismatch(const std::string& what) {
    if (result.mismatches++ == 0) result.first = what;
  }
  void on_tap(const cmodel::TapRecord& record) override {
    const auto tap = static_cast<std::size_t>(record.tap);
    const Event rtl = event_of(record);
    auto& queue = expected.events[tap];
    if (queue.empty()) {
      mismatch(std::string(cmodel::to_string(record.tap)) + ": RTL has " + text_of(rtl) + ", the model nothing");
      return;
    }
    ++result.by_tap[tap];
    ++result.comparisons;
    // Place and cycle of every event. Of every device: M-reset-5, M-check-4, M-decode-2, M-decode-3, M-path-1,
    // M-path-2, M-path-3, M-walk-4, M-slices-1, M-pipe-1; of some: M-weights-1, M-ellipse-1, M-ellipse-2, M-sample-3,
    // M-hazard-3.
    // Each tap in its cycle (M-tap-1), of its tile (M-tap-6) and sheet (M-tap-7).
    if (!(queue.front() == rtl)) {
      mismatch(std::string(cmodel::to_string(record.tap)) + ": model " + text_of(queue.front()) + ", RTL " +
               text_of(rtl));
    }
    queue.pop_front();
  }
  void equal(const char* what, std::uint64_t model, std::uint64_t rtl) {
    ++result.comparisons;
    if (model != rtl) mismatch(std::string(what) + ": model " + std::to_string(model) + ", RTL " + std::to_string(rtl));
  }
};

/// The ideal by its formula, from each sheet's windows and its blocks' slices (M-account-4, M-account-5), of densities
/// from its walk (M-density-21).
struct Ideal final : cmodel::CycleSink {
  Ideal(const cmodel::Config& config, std::span<const cmodel::Beat> beats)
      : slices_(static_cast<std::uint64_t>(config.slices())), steps_(std::max<std::uint64_t>(5, slices_)) {
    cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
    for (const cmodel::Beat& beat : beats) {
      const cmodel::Record* record = decode.feed(beat);
      if (record == nullptr) continue;
      if (const auto* tile = std::get_if<cmodel::BeginTile>(record); tile != nullptr && holds_densities(tile->mode))
        densities_.insert(tile->tile);
    }
  }
  std::uint64_t cycles = 0;
  void on_sheet(const cmodel::SheetCycles& sheet) override {
    cycles += std::max(sheet.windows, picks_before_);
    picks_before_ = sheet.blocks * slices_;
    if (!densities_.contains(sheet.tile)) return;
    // Copied, a block a cycle (M-density-6); a cycle later the previous sheet is classified (M-density-14).
    picks_before_ = waits_ ? std::max<std::uint64_t>(sheet.blocks, 1) + 1 + classified(*waits_) : sheet.blocks;
    waits_ = sheet.blocks;
  }
  void on_tile(const cmodel::TileCycles&) override {
    cycles += picks_before_ + (waits_ ? classified(*waits_) : 0);
    picks_before_ = 0;
    waits_.reset();
  }

 private:
  /// D cycles a block (M-density-10).
  std::uint64_t classified(std::uint64_t blocks) const { return std::max<std::uint64_t>(blocks * steps_, 1); }

  std::uint64_t slices_, steps_, picks_before_ = 0;
  std::optional<std::uint64_t> waits_;  ///< blocks of the sheet of densities that was not classified yet
  std::set<std::uint32_t> densities_;   ///< tiles
};

}  // namespace

CycleComparison& CycleComparison::operator+=(const CycleComparison& other) {
  for (std::size_t i = 0; i < by_tap.size(); ++i) by_tap[i] += other.by_tap[i];
  comparisons += other.comparisons;
  mismatches += other.mismatches;
  rtl_cycles += other.rtl_cycles;
  account += other.account;
  if (first.empty()) first = other.first;
  return *this;
}

void judge(const std::string& name, const CycleComparison& comparison) {
  std::printf("[figure] %s: comparisons = %llu, mismatches = %llu (limit 0) over %llu cycles;", name.c_str(),
              static_cast<unsigned long long>(comparison.comparisons),
              static_cast<unsigned long long>(comparison.mismatches),
              static_cast<unsigned long long>(comparison.rtl_cycles));
  for (int tap = 0; tap < cmodel::kTapCount; ++tap) {
    const auto count = comparison.by_tap[static_cast<std::size_t>(tap)];
    std::printf(" %s %llu", cmodel::to_string(static_cast<cmodel::Tap>(tap)), static_cast<unsigned long long>(count));
    EXPECT_GT(count, 0U) << "no event of this tap was compared";
  }
  std::printf("\n");
  ::testing::Test::RecordProperty("comparisons", std::to_string(comparison.comparisons));
  EXPECT_EQ(comparison.mismatches, 0U) << comparison.first;
}

CycleComparison compare_cycles(const cmodel::Config& config, std::span<const cmodel::Beat> beats,
                               const testbench::Pattern& input, const testbench::Pattern& output, const MakeRtl& make) {
  CycleComparison result;
  Expected expected;
  Checker checker(expected, result);
  cmodel::NullPixels pixels;
  Ideal ideal(config, beats);
  testbench::RtlOptions rtl_options;
  rtl_options.input = input;
  rtl_options.output = output;
  testbench::TapAssembly taps(config, pixels, checker);
  rtl_options.taps = &taps;
  const auto rtl = make(config, pixels, rtl_options);

  cmodel::CullLog culls;
  if (config.culls()) {
    cmodel::Model tested(config, cmodel::StreamScope::Subset, pixels);
    tested.log_culls(&culls);
    tested.consume(beats);
  }

  // Creating the device took some cycles: it read the configuration's hash.
  cmodel::CycleModel model(config, cmodel::StreamScope::Subset,
                           {.input = &input,
                            .output = &output,
                            .first_beat = rtl->cycles(),
                            .sliced = rtl->sliced(),  // M-top-1, M-top-2
                            .taps = &expected,
                            .spans = &ideal,
                            .culls = &culls});
  model.consume(beats);
  model.finish();
  rtl->consume(beats);
  rtl->finish();

  for (const auto& queue : expected.events) {
    for (const Event& event : queue) checker.mismatch("the model has " + text_of(event) + ", the RTL nothing");
  }
  result.rtl_cycles = rtl->cycles();
  result.account = model.account();
  result.stalls = model.stalls();
  result.counters = model.counters();
  // M-register-16, M-register-17; busy is M-account-1.
  const cmodel::StallCounters theirs = rtl->cycle_counters();
#define X(name, counter, meaning) checker.equal(#counter, config.counter_word(model.stalls().name), theirs.name);
  FASTSPLAT_STALL_COUNTERS(X)
#undef X
  const cmodel::Counters& counts = rtl->counters();
  checker.equal("tiles", config.counter_word(model.counters().tiles), counts.tiles);
  checker.equal("sheets", config.counter_word(model.counters().sheets), counts.sheets);
  checker.equal("splats", config.counter_word(model.counters().splats), counts.splats);
  checker.equal("windows", config.counter_word(model.counters().windows), counts.windows);
  checker.equal("cull blocks", config.counter_word(model.counters().cull_blocks), counts.cull_blocks);
  checker.equal("dirty blocks", config.counter_word(model.counters().dirty_blocks), counts.dirty_blocks);
  // M-account-2
  checker.equal("sum of the account", model.account().total(), model.stalls().busy);
  checker.equal("ideal of the account", model.account().ideal, ideal.cycles);
  return result;
}

}  // namespace fastsplat::test
