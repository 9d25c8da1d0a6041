// SPDX-License-Identifier: Apache-2.0
// The checker without a simulator: it passes the output of a correct device, and each difference is first seen by its
// detector.
#include "testbench/check/checker.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "base/error.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/check/raw_replay_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::Checker;
using testbench::CheckReport;
using testbench::Detector;
using testbench::RawPort;

struct Pixels final : cmodel::PixelSink {
  std::size_t tiles = 0, words = 0;
  void on_tile(cmodel::TilePixels&& tile) override {
    ++tiles;
    words += tile.words.size();
  }
};

/// A stream, the output of a correct device for it, and its counters.
struct Truth {
  cmodel::Config config;
  std::vector<cmodel::Beat> beats;
  std::vector<RawEvent> events;
  cmodel::Counters counters;
  cmodel::StallCounters cycles;
};

constexpr std::uint64_t kFirstBeat = 4;

Truth truth_of(const cmodel::Config& config, testbench::StimulusClass which, std::uint64_t splats) {
  Truth truth{.config = config,
              .beats = write_document(config, make_stimulus(config, which, 3, splats).document),
              .events = {},
              .counters = {},
              .cycles = {}};
  truth.events = replay(config, truth.beats);
  Pixels pixels;
  cmodel::Model model(config, cmodel::StreamScope::Whole, pixels);
  model.consume(truth.beats);
  truth.counters = model.counters();
  cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {.first_beat = kFirstBeat});
  cycles.consume(truth.beats);
  cycles.finish();
  truth.cycles = cycles.stalls();
  return truth;
}

CheckReport check(const Truth& shown) {
  Pixels pixels;
  Checker checker(shown.config, cmodel::StreamScope::Whole, pixels);
  checker.start(kFirstBeat);
  play(shown.events, checker);
  return checker.finish(shown.counters, shown.cycles);
}

class Checked : public ::testing::TestWithParam<const char*> {
 protected:
  Truth truth(testbench::StimulusClass which = testbench::StimulusClass::Mixed, std::uint64_t splats = 30) const {
    return truth_of(named_config(GetParam()), which, splats);
  }

  /// The report of `truth` with an error planted must name the detector.
  void seen(const Truth& wrong, Detector by, const std::string& what) {
    const CheckReport report = check(wrong);
    ++tried_[testbench::to_string(by)];
    EXPECT_GT(report.mismatches, 0u) << what << " is not seen";
    if (report.detector)
      EXPECT_STREQ(testbench::to_string(*report.detector), testbench::to_string(by)) << what;
    else
      ADD_FAILURE() << what << " is seen by nobody";
  }
  void TearDown() override {
    for (const auto& [detector, count] : tried_)
      std::printf("[figure] %s: differences put before %s = %d (limit > 0)\n", GetParam(), detector.c_str(), count);
  }

 private:
  std::map<std::string, int> tried_;
};

bool shows(const RawEvent& event, RawPort port) { return !event.beat && event.tap.port == port; }

/// Up to `most` events of a port, spread over the stream.
std::vector<std::size_t> some(const Truth& truth, RawPort port, std::size_t most = 6) {
  std::vector<std::size_t> all, out;
  for (std::size_t i = 0; i < truth.events.size(); ++i)
    if (shows(truth.events[i], port)) all.push_back(i);
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
    out.push_back(all[i * all.size() / std::min(most, all.size())]);
  EXPECT_FALSE(out.empty());
  return out;
}

Truth without(const Truth& truth, std::size_t event) {
  Truth wrong = truth;
  wrong.events.erase(wrong.events.begin() + static_cast<std::ptrdiff_t>(event));
  return wrong;
}
Truth twice(const Truth& truth, std::size_t event) {
  Truth wrong = truth;
  wrong.events.insert(wrong.events.begin() + static_cast<std::ptrdiff_t>(event), truth.events[event]);
  return wrong;
}
template <class Change>
Truth with(const Truth& truth, std::size_t event, Change change) {
  Truth wrong = truth;
  change(wrong.events[event]);
  return wrong;
}

TEST_P(Checked, PassesACorrectDevice) {
  for (const auto which : testbench::stimulus_classes()) {
    const Truth right = truth(which, 60);
    const CheckReport report = check(right);
    EXPECT_EQ(report.mismatches, 0u) << to_string(which);
    EXPECT_FALSE(report.detector.has_value());
    EXPECT_GT(report.comparisons, 100u) << to_string(which);
    EXPECT_EQ(report.by_tap[0], right.counters.splats);
    EXPECT_EQ(report.by_tap[1], right.counters.windows);
    EXPECT_EQ(report.by_tap[2], right.counters.windows);
    EXPECT_EQ(report.by_tap[3], right.counters.dirty_blocks);
    EXPECT_EQ(report.cycles_rtl, right.cycles.busy);
  }
}

TEST_P(Checked, EveryFieldOfASnap) {
  const Truth right = truth();
  for (const std::size_t at : some(right, RawPort::Snap)) {
    for (const auto field : {&testbench::RawTap::tag, &testbench::RawTap::x, &testbench::RawTap::y,
                             &testbench::RawTap::mx, &testbench::RawTap::my})
      seen(with(right, at, [&](RawEvent& event) { event.tap.*field ^= 1; }), Detector::Snap, "a bit of a snap");
    seen(without(right, at), Detector::Snap, "a lost snap");
    seen(twice(right, at), Detector::Snap, "a snap twice");
  }
}

// A saturated number and one that was counted to the end differ in the report.
TEST_P(Checked, SaysWhetherItStoppedCounting) {
  const Truth right = truth();
  const auto at = some(right, RawPort::Snap, 2);
  ASSERT_EQ(at.size(), 2u);
  Truth wrong = right;
  for (const std::size_t event : at) wrong.events[event].tap.tag ^= 1;
  for (const std::uint64_t most : {1, 2, 3}) {
    Pixels pixels;
    Checker checker(wrong.config, cmodel::StreamScope::Whole, pixels, {.stop_after = most});
    checker.start(kFirstBeat);
    play(wrong.events, checker);
    const CheckReport report = checker.finish(wrong.counters, wrong.cycles);
    std::printf("[figure] stopping after %llu: mismatches = %llu, stopped = %d\n",
                static_cast<unsigned long long>(most), static_cast<unsigned long long>(report.mismatches),
                report.stopped ? 1 : 0);
    // Taps continue after the checker has stopped.
    EXPECT_GE(report.mismatches, std::min<std::uint64_t>(most, 2));
    EXPECT_EQ(report.stopped, most <= 2);
  }
}

TEST_P(Checked, EveryBankOfAWindow) {
  const Truth right = truth();
  const auto lanes = static_cast<std::size_t>(right.config.lanes);
  const auto bits = static_cast<std::size_t>(right.config.radial_int_bits + right.config.radial_frac_bits);
  for (const std::size_t at : some(right, RawPort::Window)) {
    for (const auto field : {&testbench::RawTap::tag, &testbench::RawTap::x, &testbench::RawTap::y})
      seen(with(right, at, [&](RawEvent& event) { event.tap.*field ^= 1; }), Detector::Footprint, "a window's place");
    for (std::size_t bank = 0; bank < lanes * lanes; ++bank) {
      const std::size_t bit = bank * bits + bank % bits;
      seen(with(right, at, [&](RawEvent& event) { event.words[bit / 32] ^= 1U << bit % 32; }), Detector::Footprint,
           "bank " + std::to_string(bank) + " of a window");
    }
    // The sums of a sheet's last window come before they are missed.
    const auto next = std::find_if(
        right.events.begin() + static_cast<std::ptrdiff_t>(at) + 1, right.events.end(),
        [](const RawEvent& event) { return shows(event, RawPort::Window) || shows(event, RawPort::SheetDone); });
    seen(without(right, at), shows(*next, RawPort::Window) ? Detector::Footprint : Detector::Sheet, "a lost window");
    seen(twice(right, at), Detector::Footprint, "a window twice");
  }
}

/// Banks x 4 words: banks inside the tile count, others do not (M-tap-4).
void each_word(const Truth& right, std::size_t at, int bits, const std::function<void(const Truth&)>& visit,
               int& outside) {
  const auto banks = static_cast<std::size_t>(right.config.lanes) * static_cast<std::size_t>(right.config.lanes);
  const auto width = static_cast<std::size_t>(bits);
  for (std::size_t word = 0; word < banks * 4; ++word) {
    bool ones = true;  // as a bank outside the tile has them
    for (std::size_t bit = word / 4 * 4 * width; bit < (word / 4 + 1) * 4 * width; ++bit)
      ones = ones && (right.events[at].words[bit / 32] >> bit % 32 & 1) != 0;
    const std::size_t bit = word * width + word % width;
    const Truth other = with(right, at, [&](RawEvent& event) { event.words[bit / 32] ^= 1U << bit % 32; });
    if (!ones) {
      visit(other);
    } else if (check(other).mismatches == 0) {
      ++outside;
    }
  }
}

TEST_P(Checked, EveryWordOfTheSums) {
  const Truth right = truth(testbench::StimulusClass::ScreenEdges, 16);
  int outside = 0;
  for (const std::size_t at : some(right, RawPort::Sheet, 4)) {
    each_word(
        right, at, right.config.sheet_int_bits + right.config.sheet_frac_bits,
        [&](const Truth& wrong) { seen(wrong, Detector::Sheet, "a bit of a sum"); }, outside);
    seen(with(right, at, [](RawEvent& event) { event.tap.tag ^= 1; }), Detector::Sheet, "the tag of a sum");
    seen(without(right, at), Detector::Sheet, "lost sums");
    seen(twice(right, at), Detector::Sheet, "sums twice");
  }
  std::printf("[figure] %s: words of sums outside the tile that do not count = %d (limit > 0)\n", GetParam(), outside);
  EXPECT_GT(outside, 0);
}

TEST_P(Checked, EveryWordOfABlock) {
  const Truth right = truth(testbench::StimulusClass::ScreenEdges, 16);
  int outside = 0;
  for (const std::size_t at : some(right, RawPort::Composite, 4)) {
    each_word(
        right, at,
        std::max(right.config.sheet_int_bits + right.config.sheet_frac_bits, right.config.composite_frac_bits + 1),
        [&](const Truth& wrong) { seen(wrong, Detector::Composite, "a bit of a block"); }, outside);
    seen(with(right, at, [](RawEvent& event) { event.tap.block ^= 1; }), Detector::Composite, "a block's number");
    seen(without(right, at), Detector::Composite, "a lost block");
    seen(twice(right, at), Detector::Composite, "a block twice");
  }
  std::printf("[figure] %s: words of blocks outside the tile that do not count = %d (limit > 0)\n", GetParam(),
              outside);
  EXPECT_GT(outside, 0);
}

// The checker counts the ends of sheets to know the sheet of a composited block (M-tap-7). It must see one that is lost
// or repeated.
TEST_P(Checked, TheSheetOfABlock) {
  const Truth right = truth(testbench::StimulusClass::SwapHazards, 60);
  int tried = 0;
  for (const std::size_t at : some(right, RawPort::SheetDone, 12)) {
    // The next event other than beats and splats' taps: another block of the tile, or its picture.
    const auto next = std::find_if(
        right.events.begin() + static_cast<std::ptrdiff_t>(at) + 1, right.events.end(),
        [](const RawEvent& event) { return shows(event, RawPort::Composite) || shows(event, RawPort::Pixels); });
    if (next == right.events.end() || !shows(*next, RawPort::Composite)) continue;
    seen(without(right, at), Detector::Composite, "a sheet whose end is not reported");
    seen(twice(right, at), Detector::Composite, "a sheet whose end is reported twice");
    ++tried;
  }
  EXPECT_GT(tried, 0);
}

TEST_P(Checked, EveryWordOfThePixels) {
  const Truth right = truth();
  for (const std::size_t at : some(right, RawPort::Pixels)) {
    for (std::size_t word = 0; word < 4; ++word)
      seen(with(right, at, [&](RawEvent& event) { event.words[word] ^= 1; }), Detector::Pixel, "a bit of a pixel");
    seen(twice(right, at), Detector::Pixel, "pixels twice");
  }
}

// After the last tile, where nothing more is expected.
TEST_P(Checked, TapsOutsideATile) {
  const Truth right = truth();
  for (const auto& [port, detector] : {std::pair{RawPort::Snap, Detector::Snap},
                                       {RawPort::Window, Detector::Footprint},
                                       {RawPort::Sheet, Detector::Sheet},
                                       {RawPort::Composite, Detector::Composite},
                                       {RawPort::Pixels, Detector::Pixel}}) {
    Truth wrong = right;
    wrong.events.push_back(right.events[some(right, port).front()]);
    seen(wrong, detector, "an event after the last tile");
    const auto report = check(wrong);
    ASSERT_TRUE(report.first);
    EXPECT_NE(describe(right.config, *report.first).find("outside any tile"), std::string::npos);
  }
}

// All pixels are right, but they come without a tile, or a tile too early.
TEST_P(Checked, TheEndOfATile) {
  const Truth right = truth();
  int tried = 0;
  for (std::size_t at = 1; at < right.events.size(); ++at) {
    const auto& event = right.events[at];
    if (!shows(event, RawPort::Pixels) || !event.tap.last || !shows(right.events[at - 1], RawPort::Pixels)) continue;
    const bool zeros =
        std::all_of(event.words.begin(), event.words.end(), [](std::uint32_t word) { return word == 0; });
    if (!zeros)
      seen(with(right, at - 1, [](RawEvent& before) { before.tap.last = true; }), Detector::Tiles, "an aborted tile");
    Truth last_tile = with(right, at, [](RawEvent& end) { end.tap.last = false; });
    const bool another = std::any_of(right.events.begin() + static_cast<std::ptrdiff_t>(at) + 1, right.events.end(),
                                     [](const RawEvent& later) { return shows(later, RawPort::Pixels); });
    if (!another) {
      seen(last_tile, Detector::Tiles, "a tile that never ends");
      ++tried;
    }
  }
  EXPECT_EQ(tried, 1);
}

TEST_P(Checked, EveryCounter) {
  const Truth right = truth();
#define X(name, meaning)                                                                     \
  {                                                                                          \
    Truth wrong = right;                                                                     \
    ++wrong.counters.name;                                                                   \
    seen(wrong, Detector::Counters, "counter " #name);                                       \
    const auto report = check(wrong);                                                        \
    EXPECT_EQ(report.mismatches, 1u);                                                        \
    ASSERT_EQ(report.differences.size(), 1u);                                                \
    EXPECT_NE(report.differences[0].find("counter " #name ": expected"), std::string::npos); \
  }
  FASTSPLAT_COUNTERS(X)
#undef X
}

TEST_P(Checked, EveryCycleCounter) {
  const Truth right = truth();
#define X(name, counter, meaning)           \
  {                                         \
    Truth wrong = right;                    \
    ++wrong.cycles.name;                    \
    seen(wrong, Detector::Cycles, meaning); \
    EXPECT_EQ(check(wrong).mismatches, 1u); \
  }
  FASTSPLAT_STALL_COUNTERS(X)
#undef X
}

TEST_P(Checked, ADeviceThatShowsNothing) {
  Truth mute = truth();
  std::erase_if(mute.events, [](const RawEvent& event) { return !event.beat; });
  const auto report = check(mute);
  EXPECT_EQ(report.detector, Detector::Snap);
  EXPECT_FALSE(report.differences.empty());
  EXPECT_GT(report.mismatches, mute.counters.splats + 2 * mute.counters.windows + mute.counters.dirty_blocks);
}

TEST_P(Checked, StopsAfterTooManyDifferences) {
  Truth wrong = truth();
  for (auto& event : wrong.events)
    if (shows(event, RawPort::Snap)) event.tap.mx ^= 1;
  Pixels pixels;
  Checker checker(wrong.config, cmodel::StreamScope::Whole, pixels, {.stop_after = 3});
  checker.start(kFirstBeat);
  std::size_t events = 0;
  for (; events < wrong.events.size() && !checker.stopped(); ++events) play({&wrong.events[events], 1}, checker);
  EXPECT_LT(events, wrong.events.size());
  const auto report = checker.finish(wrong.counters, wrong.cycles);
  EXPECT_EQ(report.mismatches, 3u);
  EXPECT_FALSE(report.cycles_rtl.has_value()) << "the run has not reached its end";
}

TEST_P(Checked, HandsOnTheTilesOfTheDevice) {
  const Truth right = truth();
  Pixels pixels;
  Checker checker(right.config, cmodel::StreamScope::Whole, pixels);
  play(right.events, checker);
  EXPECT_EQ(pixels.tiles, right.counters.tiles);
  EXPECT_GT(pixels.words, 0u);
}

TEST_P(Checked, RefusesAnIllegalStream) {
  const Truth right = truth();
  Pixels pixels;
  Checker cut(right.config, cmodel::StreamScope::Whole, pixels);
  cut.accept(right.beats.front());
  EXPECT_THROW(cut.end_of_stream(), UserError);
  Checker illegal(right.config, cmodel::StreamScope::Whole, pixels);
  EXPECT_THROW(illegal.accept(right.beats.back()), UserError);
}

INSTANTIATE_TEST_SUITE_P(Configurations, Checked, ::testing::Values("tiny", "faults/mustfail", "base"),
                         [](const auto& param) {
                           const std::string path = param.param;
                           return path.substr(path.rfind('/') + 1);
                         });

}  // namespace
}  // namespace fastsplat::test
