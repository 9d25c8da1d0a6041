// SPDX-License-Identifier: Apache-2.0
// The checker itself: passes correct devices; finds, reports, shrinks and replays errors.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <mutex>

#include "cmodel/decode/stream_decode.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "testbench/triage/failure.hpp"

namespace fastsplat::testbench {
namespace {

/// The effect of a broken device on a tap: changes it, or loses it.
using Damage = std::function<bool(RawTap&, std::vector<std::uint32_t>&)>;

class DamagedTaps final : public RawTapSink {
 public:
  DamagedTaps(RawTapSink* to, Damage damage) : to_(to), damage_(std::move(damage)) {}
  void on_raw(const RawTap& tap) override {
    RawTap changed = tap;
    std::vector<std::uint32_t> words(tap.words.begin(), tap.words.end());
    if (!damage_(changed, words)) return;
    changed.words = words;
    to_->on_raw(changed);
  }
  void accept(const cmodel::Beat& beat) override { to_->accept(beat); }

 private:
  RawTapSink* to_;
  Damage damage_;
};

/// The ports whose words are compared, with their detectors.
constexpr std::pair<RawPort, Detector> kPorts[] = {{RawPort::Snap, Detector::Snap},
                                                   {RawPort::Window, Detector::Footprint},
                                                   {RawPort::Sheet, Detector::Sheet},
                                                   {RawPort::Composite, Detector::Composite},
                                                   {RawPort::Pixels, Detector::Pixel}};

VerifyOptions tiny() {
  VerifyOptions options;
  options.config = driver::load_config("tiny");
  options.seed = 5;
  return options;
}

VerifyOptions damaged(const Damage& damage) {
  VerifyOptions options = tiny();
  struct Kept {
    std::mutex mutex;
    std::vector<std::unique_ptr<DamagedTaps>> taps;
  };
  options.device = [damage, keep = std::make_shared<Kept>()](cmodel::PixelSink& pixels, const RtlOptions& given) {
    const std::lock_guard lock(keep->mutex);
    keep->taps.push_back(std::make_unique<DamagedTaps>(given.taps, damage));
    RtlOptions rtl = given;
    rtl.taps = keep->taps.back().get();
    return make_rtl_device(driver::load_config("tiny"), pixels, rtl);
  };
  return options;
}

BeatSource mixed(std::uint64_t splats) {
  const auto config = driver::load_config("tiny");
  return source_of(write_document(config, make_stimulus(config, StimulusClass::Mixed, 3, splats).document));
}

TEST(Checker, PassesTheRtlAndComparesEveryTap) {
  const auto result = verify(mixed(200), tiny());
  EXPECT_EQ(result.verdict, Verdict::Pass);
  EXPECT_EQ(result.check.mismatches, 0u);
  for (int tap = 0; tap < cmodel::kTapCount; ++tap)
    EXPECT_GT(result.check.by_tap[static_cast<std::size_t>(tap)], 0u) << tap;
  EXPECT_EQ(result.check.by_tap[0], result.counters.splats);
  std::printf("[figure] comparisons = %llu\n", static_cast<unsigned long long>(result.check.comparisons));
}

TEST(Checker, SeesOneDamagedEventOfEachTap) {
  for (const auto& [port, detector] : kPorts) {
    auto left = std::make_shared<int>(5);  // the fifth
    const auto result = verify(mixed(100), damaged([port = port, left](RawTap& tap, std::vector<std::uint32_t>& words) {
                                 if (tap.port != port || --*left != 0) return true;
                                 tap.mx ^= 1;
                                 for (auto& word : words) word = ~word;
                                 return true;
                               }));
    EXPECT_EQ(result.verdict, Verdict::Mismatch);
    EXPECT_EQ(result.check.detector, detector);
    // A pixel is also seen in its tile.
    const bool pixel = port == RawPort::Pixels;
    EXPECT_EQ(result.check.mismatches > 1, pixel) << to_string(detector);
    ASSERT_TRUE(result.check.first);
    EXPECT_FALSE(result.check.first->header);
    EXPECT_EQ(result.check.differences.size(), pixel ? 1u : 0u);
  }
}

TEST(Checker, SeesALostEventOfEachTap) {
  for (const auto& [port, detector] : kPorts) {
    auto left = std::make_shared<int>(3);
    const auto result = verify(mixed(100), damaged([port = port, left](RawTap& tap, std::vector<std::uint32_t>&) {
                                 return tap.port != port || --*left != 0;
                               }));
    EXPECT_EQ(result.verdict, Verdict::Mismatch);
    EXPECT_EQ(result.check.detector, detector);
  }
}

TEST(Checker, ARunWithoutComparisonsIsNotAPass) {
  StreamDocument empty;
  const auto config = driver::load_config("tiny");
  empty.width = empty.height = 1;
  const auto result = verify(source_of(write_document(config, empty)), tiny());
  EXPECT_EQ(result.verdict, Verdict::NothingCompared);
  EXPECT_EQ(exit_code(result.verdict), ExitCode::Failed);
}

TEST(Failure, IsShrunkExplainedAndReplayed) {
  // A device whose weights are wrong for one window phase.
  const auto options = damaged([](RawTap& tap, std::vector<std::uint32_t>&) {
    if (tap.port == RawPort::Snap && tap.mx == 3) tap.mx = 4;
    return true;
  });
  const auto source = mixed(300);
  const auto failed = verify(source, options);
  ASSERT_EQ(failed.verdict, Verdict::Mismatch);
  const auto wave = std::filesystem::temp_directory_path() / ("fastsplat-wave-" + std::to_string(::getpid()) + ".fst");
  const auto report = investigate(source, options, failed, wave, 400);
  EXPECT_TRUE(report.shrink.finished);
  EXPECT_EQ(report.shrink.splats_after, 1u);
  EXPECT_NE(report.divergence.find("stage snap"), std::string::npos) << report.divergence;
  EXPECT_NE(report.divergence.find("mx 0x3, RTL 0x4 (differs in 0x7"), std::string::npos) << report.divergence;
  EXPECT_NE(report.operands.find("rho="), std::string::npos) << report.operands;
  EXPECT_LE(report.wave_to - report.wave_from, 80u);
  EXPECT_GT(std::filesystem::file_size(wave), 0u);
  std::filesystem::remove(wave);
  const auto again = verify(source_of(write_document(options.config, report.document)), report.options);
  EXPECT_EQ(again.verdict, Verdict::Mismatch);
  std::printf("[figure] shrunk splats = %llu of %llu in %d runs\n",
              static_cast<unsigned long long>(report.shrink.splats_after),
              static_cast<unsigned long long>(report.shrink.splats_before), report.shrink.runs);
}

// Wrong from the fourth seed on, two classes a seed: run 6 of 0 to 11 is the first to fail.
TEST(Campaign, FailsTheSameOnAnyNumberOfThreads) {
  CampaignOptions campaign;
  campaign.verify = damaged([](RawTap&, std::vector<std::uint32_t>&) { return true; });
  campaign.splats = 60;
  campaign.seeds = 6;
  campaign.classes = {StimulusClass::Mixed, StimulusClass::EmptySheets};
  const auto right = campaign.verify.device;
  const auto wrong = damaged([](RawTap& tap, std::vector<std::uint32_t>&) {
                       tap.mx ^= 1;
                       return true;
                     }).device;
  const std::uint64_t first = campaign.verify.seed;
  campaign.verify.device = [=](cmodel::PixelSink& pixels, const RtlOptions& rtl) {
    return (rtl.seed >= first + 3 ? wrong : right)(pixels, rtl);
  };
  std::optional<CampaignResult> one;
  for (const int threads : {1, 2, 4}) {
    campaign.threads = threads;
    const auto result = run_campaign(campaign);
    ASSERT_TRUE(result.failed);
    EXPECT_EQ(*result.failed, 6u);
    EXPECT_EQ(result.streams, 7u);
    EXPECT_EQ(result.total.check.detector, Detector::Snap);
    if (!one) one = result;
    EXPECT_EQ(result.total.check.comparisons, one->total.check.comparisons);
    EXPECT_EQ(result.total.check.mismatches, one->total.check.mismatches);
    EXPECT_EQ(result.total.last_cycle, one->total.last_cycle);
    EXPECT_TRUE(result.total.counters == one->total.counters);
  }
  std::printf("[figure] first failed run = %zu, comparisons up to it = %llu, on 1, 2 and 4 threads\n", *one->failed,
              static_cast<unsigned long long>(one->total.check.comparisons));
}

TEST(Stimulus, EveryClassIsLegalAndRepeatable) {
  for (const char* name : {"tiny", "small", "base"}) {
    const auto config = driver::load_config(name);
    for (const auto which : stimulus_classes()) {
      const auto beats = write_document(config, make_stimulus(config, which, 1, 60).document);
      cmodel::StreamDecode decode(config, cmodel::StreamScope::Whole);
      for (const auto& beat : beats) decode.feed(beat);
      EXPECT_NO_THROW(decode.finish());
      EXPECT_EQ(beats, write_document(config, make_stimulus(config, which, 1, 60).document)) << to_string(which);
      EXPECT_EQ(beats, write_document(config, read_document(config, beats))) << to_string(which);
    }
  }
}

TEST(Random, EveryClassPassesAndReachesItsCorner) {
  for (const auto which : stimulus_classes()) {
    CampaignOptions campaign;
    campaign.verify = tiny();
    campaign.splats = 400;
    campaign.seeds = 3;
    campaign.classes = {which};
    const auto result = run_campaign(campaign);
    EXPECT_EQ(result.total.verdict, Verdict::Pass) << to_string(which);
    EXPECT_EQ(result.total.counters.splats, 1200u) << to_string(which);
    if (which == StimulusClass::Saturation) {
      EXPECT_GT(result.total.counters.sheet_saturated, 0u);
      EXPECT_GT(result.total.counters.opacity_saturated, 0u);
      EXPECT_GT(result.total.counters.composite_saturated, 0u);
      EXPECT_GT(result.total.counters.pixel_saturated, 0u);
    }
    if (which == StimulusClass::OffTile) {
      EXPECT_EQ(result.total.counters.lanes_inside, 0u);
    }
    if (which == StimulusClass::MultiWindow) {
      EXPECT_GT(result.total.counters.windows, 2 * result.total.counters.splats);
    }
  }
}

}  // namespace
}  // namespace fastsplat::testbench
