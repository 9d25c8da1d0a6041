// SPDX-License-Identifier: Apache-2.0
// The verdict check without a simulator: a correct device passes, every difference is reported.
#include "testbench/check/verdict_check.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "testbench/check/checker.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::VerdictCycles;
using testbench::Detector;
using testbench::RawPort;
using testbench::RawTap;

RawTap tap_of(const VerdictCycles& verdict) {
  return {
      .port = RawPort::Verdict, .cycle = verdict.reported, .tag = verdict.tag, .hidden = verdict.hidden, .words = {}};
}

std::vector<cmodel::Beat> stream(const cmodel::Config& config) {
  return write_document(config, make_stimulus(config, testbench::StimulusClass::Mixed, 3, 300).document);
}

/// The cycle model's verdicts for a stream with hidden groups.
std::vector<VerdictCycles> verdicts_of(const cmodel::Config& config, const std::vector<cmodel::Beat>& beats) {
  struct Listener final : cmodel::CycleSink {
    std::vector<VerdictCycles> all;
    void on_verdict(const VerdictCycles& verdict) override { all.push_back(verdict); }
    void on_sheet(const cmodel::SheetCycles&) override {}
    void on_tile(const cmodel::TileCycles&) override {}
  } listener;
  cmodel::NullPixels pixels;
  cmodel::CullLog culls;
  cmodel::Model model(config, cmodel::StreamScope::Whole, pixels);
  model.log_culls(&culls);
  model.consume(beats);
  cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {.spans = &listener, .culls = &culls});
  cycles.consume(beats);
  cycles.finish();
  return listener.all;
}

class Verdicts : public ::testing::Test {
 protected:
  const cmodel::Config config_ = named_config("faults/cull");
  const std::vector<cmodel::Beat> beats_ = stream(config_);
  const std::vector<VerdictCycles> right_ = verdicts_of(config_, beats_);

  void SetUp() override {
    const auto hidden = std::ranges::count_if(right_, [](const VerdictCycles& verdict) { return verdict.hidden; });
    std::printf("[figure] verdicts = %zu (limit >= 40), hidden = %td (limit >= 5)\n", right_.size(), hidden);
    ASSERT_GE(right_.size(), 40u);
    ASSERT_GE(hidden, 5);
  }

  /// Differences for a device that reports these.
  std::vector<std::string> differences(const std::vector<VerdictCycles>& shown) const {
    testbench::VerdictCheck check;
    for (const auto& verdict : right_) check.on_verdict(verdict);
    std::vector<std::string> out;
    for (const auto& verdict : shown)
      if (const auto difference = check.compare(tap_of(verdict))) out.push_back(*difference);
    while (const auto missing = check.missing()) out.push_back(*missing);
    return out;
  }
};

// M-port-8, M-cull-4: the checker's verdicts, which mustfail/cull_test.cpp compares with the RTL's.
TEST_F(Verdicts, OnePerCullBlockInTheirOrder) {
  std::size_t cull_blocks = 0;
  cmodel::StreamDecode decode(config_, cmodel::StreamScope::Whole);
  for (const auto& beat : beats_) {
    const cmodel::Record* record = decode.feed(beat);
    const auto* set = record == nullptr ? nullptr : std::get_if<cmodel::CullBlock>(record);
    if (set == nullptr) continue;
    ASSERT_LT(cull_blocks, right_.size());
    EXPECT_EQ(right_[cull_blocks].tag, set->tag);
    if (cull_blocks > 0) {
      EXPECT_GT(right_[cull_blocks].reported, right_[cull_blocks - 1].reported);
    }
    ++cull_blocks;
  }
  EXPECT_EQ(cull_blocks, right_.size());
}

TEST_F(Verdicts, EveryFieldOfEach) {
  EXPECT_TRUE(differences(right_).empty());
  for (std::size_t at = 0; at < right_.size(); ++at) {
    auto tag = right_, hidden = right_, late = right_, lost = right_, twice = right_;
    tag[at].tag ^= 1u << at % 32;
    hidden[at].hidden = !hidden[at].hidden;
    ++late[at].reported;
    lost.erase(lost.begin() + static_cast<std::ptrdiff_t>(at));
    twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(at), right_[at]);
    EXPECT_EQ(differences(tag).size(), 1u);
    EXPECT_EQ(differences(hidden).size(), 1u);
    EXPECT_EQ(differences(late).size(), 1u);
    EXPECT_GE(differences(lost).size(), 1u);
    EXPECT_GE(differences(twice).size(), 1u);
  }
}

TEST_F(Verdicts, AreTheCheckersBusiness) {
  for (const bool mute : {true, false}) {
    cmodel::NullPixels pixels;
    testbench::Checker checker(config_, cmodel::StreamScope::Subset, pixels, {.verdicts = true});
    checker.start(0);
    std::size_t next = 0;
    cmodel::StreamDecode decode(config_, cmodel::StreamScope::Whole);
    for (const auto& beat : beats_) {
      checker.accept(beat);
      // All verdicts that the cycle model expects so far; it gets no other input.
      const cmodel::Record* record = decode.feed(beat);
      if (record == nullptr || !std::holds_alternative<cmodel::CullBlock>(*record)) continue;
      ASSERT_LT(next, right_.size());
      if (!mute) checker.on_raw(tap_of(right_[next]));
      ++next;
      if (checker.report().mismatches > 0) break;
    }
    EXPECT_EQ(checker.report().mismatches, 0u);
    const auto report = checker.finish();
    const auto missing = std::ranges::count_if(
        report.differences, [](const std::string& text) { return text.starts_with("verdict: expected tag"); });
    EXPECT_EQ(missing > 0, mute);
    std::printf("[figure] differences of a device that tells %s verdict = %td\n", mute ? "no" : "each", missing);
  }
}

// M-port-9
TEST_F(Verdicts, ADeviceWithoutCullingHasNoVerdicts) {
  cmodel::NullPixels pixels;
  testbench::Checker deaf(named_config("tiny"), cmodel::StreamScope::Whole, pixels);
  deaf.start(0);
  deaf.on_raw(tap_of(right_.front()));
  EXPECT_EQ(deaf.report().mismatches, 0u) << "who shows no verdicts is not asked for them";
  testbench::Checker checker(named_config("tiny"), cmodel::StreamScope::Whole, pixels, {.verdicts = true});
  checker.on_raw(tap_of(right_.front()));
  EXPECT_EQ(checker.report().mismatches, 0u) << "cycles, and so verdicts, are not compared yet";
  checker.start(0);
  checker.on_raw(tap_of(right_.front()));
  EXPECT_EQ(checker.report().detector, Detector::Verdicts);
  ASSERT_EQ(checker.report().differences.size(), 1u);
  EXPECT_NE(checker.report().differences[0].find("expected none"), std::string::npos);
}

}  // namespace
}  // namespace fastsplat::test
