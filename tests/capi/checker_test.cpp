// SPDX-License-Identifier: Apache-2.0
// The checker through the C interface: passes a correct device, names the first difference of a wrong one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "testbench/capi/fastsplat_dpi.h"
#include "tests/capi/truth_helper.hpp"

namespace fastsplat::test {
namespace {

fastsplat_report report_of(const Checker& checker) {
  fastsplat_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(fastsplat_checker_report(checker.handle, &report), FASTSPLAT_OK) << fastsplat_last_error();
  return report;
}

fastsplat_status run(const Truth& truth, const Checker& checker, std::uint32_t given = ~0U) {
  EXPECT_EQ(fastsplat_checker_start(checker.handle, kFirstBeat), FASTSPLAT_OK) << fastsplat_last_error();
  EXPECT_EQ(report_all(truth.events, checker.handle, given), FASTSPLAT_OK) << fastsplat_last_error();
  return fastsplat_checker_finish(checker.handle, truth.counters.data(), truth.counters.size());
}

TEST(CapiChecker, PassesARightDevice) {
  std::uint64_t comparisons = 0;
  for (const char* name : {"tiny", "small", "base"}) {
    const Config config(name);
    const Checker checker(config);
    EXPECT_EQ(run(truth_of(name), checker), FASTSPLAT_OK) << fastsplat_last_error();
    const auto report = report_of(checker);
    EXPECT_EQ(report.verdict, FASTSPLAT_VERDICT_PASS);
    EXPECT_EQ(report.detector, -1);
    EXPECT_EQ(report.mismatches, 0u);
    EXPECT_EQ(report.cycles_compared, 1);
    EXPECT_EQ(report.cycles_device, report.cycles_model);
    for (const auto records : report.by_tap) EXPECT_GT(records, 0u);
    EXPECT_STREQ(fastsplat_checker_first_mismatch(checker.handle), "");
    EXPECT_TRUE(std::string(fastsplat_checker_summary(checker.handle)).starts_with("pass: configuration ")) << name;
    comparisons += report.comparisons;
  }
  std::printf("[figure] capi_comparisons = %llu (limit > 1000)\n", static_cast<unsigned long long>(comparisons));
  EXPECT_GT(comparisons, 1000u);
}

/// The first event at `port`, counted from the end of the stream's first half.
RawEvent& event_at(Truth& truth, testbench::RawPort port) {
  for (std::size_t i = truth.events.size() / 2; i < truth.events.size(); ++i)
    if (!truth.events[i].beat && truth.events[i].tap.port == port) return truth.events[i];
  throw std::runtime_error("no such event");
}

/// A device without verdicts.
void show_a_verdict(Truth& truth) {
  const auto at = std::ranges::find_if(truth.events, [](const RawEvent& event) { return !event.beat; });
  const std::uint64_t cycle = at->tap.cycle;
  truth.events.insert(
      at + 1, {.beat = std::nullopt,
               .tap = {.port = testbench::RawPort::Verdict, .cycle = cycle, .tag = 7, .hidden = true, .words = {}},
               .words = {}});
}

fastsplat_checker_options with_verdicts() {
  fastsplat_checker_options options{};
  options.struct_size = sizeof options;
  options.verdicts = 1;
  return options;
}

TEST(CapiChecker, NamesTheFirstDifference) {
  using testbench::RawPort;
  struct Case {
    const char* what;
    std::function<void(Truth&)> spoil;
    std::int32_t detector;
    const char* text;
  };
  const Case cases[] = {
      {"snap", [](Truth& t) { event_at(t, RawPort::Snap).tap.mx ^= 1; }, FASTSPLAT_TAP_SNAP, "stage snap"},
      {"weight", [](Truth& t) { event_at(t, RawPort::Window).words[0] ^= 1; }, FASTSPLAT_TAP_FOOTPRINT, "footprint"},
      {"pixel", [](Truth& t) { event_at(t, RawPort::Pixels).words[0] ^= 1; }, FASTSPLAT_TAP_PIXEL, "pixel"},
      {"keep", [](Truth& t) { *event_at(t, RawPort::Pixels).tap.keep ^= 1; }, FASTSPLAT_TAP_PIXEL, "stage pixel"},
      {"tile", [](Truth& t) { ++*event_at(t, RawPort::Window).tap.tile; }, FASTSPLAT_TAP_FOOTPRINT, "tile"},
      {"cut", [](Truth& t) { event_at(t, RawPort::Pixels).tap.cut = true; }, 5,
       "marked as belonging to an aborted tile"},
      {"verdict", show_a_verdict, 8, "verdict: expected none, RTL tag 7 hidden in cycle"},
      {"counter", [](Truth& t) { ++t.counters[2]; }, 6, "counter splats: expected"},
      {"cycles", [](Truth& t) { ++t.counters[16]; }, 7, "cycles: expected"},
  };
  const Config config("tiny");
  for (const auto& one : cases) {
    Truth wrong = truth_of("tiny");
    one.spoil(wrong);
    const auto options = with_verdicts();
    const Checker checker(config, &options);
    EXPECT_EQ(run(wrong, checker), FASTSPLAT_FAILED) << one.what;
    const auto report = report_of(checker);
    EXPECT_EQ(report.verdict, FASTSPLAT_VERDICT_MISMATCH) << one.what;
    EXPECT_EQ(report.detector, one.detector) << one.what;
    const std::string first = fastsplat_checker_first_mismatch(checker.handle);
    EXPECT_NE(first.find(one.text), std::string::npos) << one.what << ": " << first;
    EXPECT_NE(std::string(fastsplat_last_error()).find(first), std::string::npos);
    std::printf("[figure] seen_%s = %s (limit one line)\n", one.what, first.c_str());
  }
}

TEST(CapiChecker, ARefusedStreamNamesItself) {
  const Config config("tiny");
  const Checker checker(config);
  EXPECT_EQ(fastsplat_checker_start(checker.handle, kFirstBeat), FASTSPLAT_OK);
  const cmodel::Beat wrong{0xdeadbeef};
  EXPECT_EQ(fastsplat_checker_took(checker.handle, wrong.data(), 1), FASTSPLAT_INPUT);
  const std::string first = fastsplat_checker_first_mismatch(checker.handle);
  std::printf("[figure] refused stream = %s\n", first.c_str());
  EXPECT_NE(first.find("0xef"), std::string::npos) << first;
}

/// As the SystemVerilog monitor reports it: each argument of a port reaches its comparison.
TEST(CapiChecker, EveryPortOfTheMonitorIsCompared) {
  using testbench::RawPort;
  const Truth& truth = truth_of("tiny");
  const auto check_port = [&](RawPort wrong, const char* what, auto spoil) {
    void* checker = fastsplat_dpi_checker("tiny", cmodel::config_hash(truth.config), "always", "always", 1);
    ASSERT_NE(checker, nullptr) << fastsplat_last_error();
    const auto owner = static_cast<fastsplat_checker*>(checker);
    EXPECT_EQ(fastsplat_checker_start(owner, kFirstBeat), FASTSPLAT_OK);
    for (const auto& event : truth.events) {
      auto tap = event.tap;
      if (!event.beat && tap.port == wrong) spoil(tap);
      const std::uint32_t tile = tap.tile.value_or(0), words = static_cast<std::uint32_t>(event.words.size());
      const std::uint32_t* vector = event.words.data();
      fastsplat_status status = FASTSPLAT_OK;
      if (event.beat)
        status = fastsplat_dpi_took(checker, event.beat->data());
      else if (tap.port == RawPort::Snap)
        status = fastsplat_dpi_snap(checker, tap.cycle, tile, tap.tag, tap.x, tap.y, tap.mx, tap.my);
      else if (tap.port == RawPort::Sheet)
        status = fastsplat_dpi_sheet(checker, tap.cycle, tile, tap.tag, vector, words);
      else if (tap.port == RawPort::Window)
        status = fastsplat_dpi_window(checker, tap.cycle, tile, tap.tag, tap.x, tap.y, vector, words);
      else if (tap.port == RawPort::Composite)
        status = fastsplat_dpi_composite(checker, tap.cycle, tile, tap.block, vector, words);
      else if (tap.port == RawPort::SheetDone)
        status = fastsplat_dpi_sheet_done(checker, tap.cycle);
      else
        status = fastsplat_dpi_pixels(checker, tap.cycle, tile, vector, words, tap.keep.value_or(0), tap.last, tap.cut);
      ASSERT_EQ(status, FASTSPLAT_OK) << fastsplat_last_error();
    }
    if (wrong == RawPort::Verdict) {
      EXPECT_EQ(fastsplat_dpi_verdict(checker, 1'000'000, 7, 1), FASTSPLAT_OK);
    }
    std::vector<std::uint32_t> counters;
    for (const auto value : truth.counters)
      counters.insert(counters.end(), {static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(value >> 32)});
    EXPECT_EQ(fastsplat_dpi_finish(checker, counters.data(), static_cast<std::uint32_t>(counters.size())),
              *what == '\0' ? FASTSPLAT_OK : FASTSPLAT_FAILED)
        << what;
    const std::string first = fastsplat_checker_first_mismatch(owner);
    std::printf("[figure] dpi_first = %s (limit %s)\n", first.c_str(), what);
    EXPECT_NE(first.find(what), std::string::npos) << first;
    EXPECT_EQ(fastsplat_checker_destroy(owner), FASTSPLAT_OK);
  };
  check_port(RawPort::SheetDone, "", [](auto&) {});
  for (const auto& [port, what] : {std::pair{RawPort::Snap, "stage snap, tile 9"},
                                   {RawPort::Sheet, "stage sheet, tile 9"},
                                   {RawPort::Window, "stage footprint, tile 9"},
                                   {RawPort::Composite, "stage composite, tile 9"},
                                   {RawPort::Pixels, "stage pixel, tile 9"}})
    check_port(port, what, [](auto& tap) { tap.tile = 9; });
  check_port(RawPort::Pixels, "RTL has stage pixel", [](auto& tap) { *tap.keep ^= 1; });
  check_port(RawPort::Pixels, "marked as belonging to an aborted tile", [](auto& tap) { tap.cut = true; });
  check_port(RawPort::Verdict, "verdict: expected none, RTL tag 7 hidden", [](auto&) {});
}

TEST(CapiChecker, PortsThatABenchLacksAreNotCompared) {
  const Config config("tiny");
  Truth wrong = truth_of("tiny");
  *event_at(wrong, testbench::RawPort::Pixels).tap.keep ^= 1;
  ++*event_at(wrong, testbench::RawPort::Window).tap.tile;
  show_a_verdict(wrong);
  const Checker without(config), keep(config), tile(config);
  EXPECT_EQ(run(wrong, without, 0), FASTSPLAT_OK) << fastsplat_last_error();
  EXPECT_EQ(run(wrong, keep, FASTSPLAT_GIVEN_KEEP), FASTSPLAT_FAILED);
  EXPECT_EQ(report_of(keep).detector, FASTSPLAT_TAP_PIXEL);
  EXPECT_EQ(run(wrong, tile, FASTSPLAT_GIVEN_TILE), FASTSPLAT_FAILED);
  EXPECT_EQ(report_of(tile).detector, FASTSPLAT_TAP_FOOTPRINT);
}

TEST(CapiChecker, APassThatComparedNothingIsAFailure) {
  const Config config("tiny");
  fastsplat_checker_options options{};
  options.struct_size = sizeof options;
  options.scope = FASTSPLAT_SUBSET;
  const Checker checker(config, &options);
  const Truth& truth = truth_of("tiny");
  ASSERT_EQ(fastsplat_checker_took(checker.handle, words_of(truth.beats), 1), FASTSPLAT_OK);
  EXPECT_EQ(report_of(checker).verdict, FASTSPLAT_VERDICT_OPEN);
  EXPECT_EQ(fastsplat_checker_finish(checker.handle, nullptr, 0), FASTSPLAT_FAILED);
  EXPECT_EQ(report_of(checker).verdict, FASTSPLAT_VERDICT_NOTHING_COMPARED);
  EXPECT_NE(std::string(fastsplat_last_error()).find("nothing compared"), std::string::npos);
}

TEST(CapiChecker, ASilentDeviceFailsAndCountersMayBeLeftOut) {
  const Config config("tiny");
  const Truth& truth = truth_of("tiny");
  const Checker silent(config), quiet(config);
  ASSERT_EQ(fastsplat_checker_took(silent.handle, words_of(truth.beats), truth.beats.size()), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_checker_finish(silent.handle, nullptr, 0), FASTSPLAT_FAILED);
  EXPECT_EQ(report_all(truth.events, quiet.handle), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_checker_finish(quiet.handle, nullptr, 0), FASTSPLAT_OK) << fastsplat_last_error();
  EXPECT_EQ(report_of(quiet).cycles_compared, 0);
}

TEST(CapiChecker, StopsAfterSoManyMismatchesAndResets) {
  const Config config("tiny");
  fastsplat_checker_options options{};
  options.struct_size = sizeof options;
  options.stop_after = 3;
  const Checker checker(config, &options);
  Truth wrong = truth_of("tiny");
  for (auto& event : wrong.events)
    if (!event.beat && !event.words.empty()) event.words[0] ^= 1;
  EXPECT_EQ(run(wrong, checker), FASTSPLAT_FAILED);
  std::int32_t stopped = 0;
  ASSERT_EQ(fastsplat_checker_stopped(checker.handle, &stopped), FASTSPLAT_OK);
  EXPECT_EQ(stopped, 1);
  EXPECT_GE(report_of(checker).mismatches, 3u);
  ASSERT_EQ(fastsplat_checker_reset(checker.handle), FASTSPLAT_OK);
  EXPECT_EQ(run(truth_of("tiny"), checker), FASTSPLAT_OK) << fastsplat_last_error();
}

}  // namespace
}  // namespace fastsplat::test
