// SPDX-License-Identifier: Apache-2.0
// The checker: compares a device's outputs for the beats that it took with the model and the cycle model: every tap,
// pixel and counter, and the cycles. It drives nothing and depends on no simulator.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "testbench/check/scoreboard.hpp"
#include "testbench/check/verdict_check.hpp"
#include "testbench/device/raw_taps.hpp"
#include "testbench/device/tap_assembly.hpp"

namespace fastsplat::testbench {

/// Parts of the checker that can find a difference. The first five are the taps, in their order.
enum class Detector : std::uint8_t {
  Snap,
  Footprint,
  Sheet,
  Composite,
  Pixel,
  Tiles,     ///< whole tiles: cut short, too long, missing
  Counters,  ///< the device's, except the next
  Cycles,    ///< its cycle counters
  Verdicts,  ///< the device's verdicts on cull_blocks
};
const char* to_string(Detector detector);

/// Result of a check, so far or at its end.
struct CheckReport {
  std::uint64_t comparisons = 0;  ///< tap records, pixel words, counters, cycles and verdicts
  std::uint64_t mismatches = 0;
  bool stopped = false;                                   ///< at the last of these: there may be more
  std::optional<Detector> detector;                       ///< that found the first mismatch
  std::array<std::uint64_t, cmodel::kTapCount> by_tap{};  ///< records compared
  std::optional<Divergence> first;                        ///< of the taps
  std::vector<Divergence> kept;                           ///< of the taps, in their order, at most CheckOptions::keep
  std::array<std::uint64_t, cmodel::kTapCount> mismatches_by_tap{};  ///< records; all mismatches
  std::vector<std::string> differences;  ///< tiles, counters, cycles and verdicts that differ, in words
  /// Busy cycles of the device and of the cycle model; absent if the run did not reach its end.
  std::optional<std::uint64_t> cycles_rtl, cycles_model;
};

struct CheckOptions {
  std::uint64_t stop_after = 1000;               ///< mismatches; then no more beats are taken
  std::size_t keep = 0;                          ///< number of divergences listed in CheckReport::kept
  const cmodel::ReadyPattern* source = nullptr;  ///< when beats are offered to the device; null: always
  const cmodel::ReadyPattern* sink = nullptr;    ///< when its pixels are taken; null: always
  bool verdicts = false;                         ///< the device's verdicts are reported, too; else they are ignored
};

/// Receives everything in the order of the device's cycles (RawTapSink): start(), then beats and taps as they pass,
/// end_of_stream(), and finish() once the device has come to rest. Memory stays bounded by the device's depth, whatever
/// the stream's length.
class Checker final : public RawTapSink {
 public:
  /// `pixels` receives the device's tiles (not the model's). What `options` points to outlives the checker.
  Checker(const cmodel::Config& config, cmodel::StreamScope scope, cmodel::PixelSink& pixels,
          const CheckOptions& options = {});

  /// The cycle after reset from which the source has the first beat, and whether register slices lie at the streams.
  /// Without it neither cycles nor verdicts are compared.
  void start(std::uint64_t first_beat, bool sliced = false);
  bool started() const { return cycle_model_.has_value(); }
  /// The cycle in which an illegal beat taken in cycle `taken` is checked, by the cycle model; 0 if cycles are not
  /// compared.
  std::uint64_t checked_at(std::uint64_t taken) const { return cycle_model_ ? cycle_model_->checked_at(taken) : 0; }

  /// Throws UserError (Input) for a beat that breaks docs/stream.md. After stopped() nothing more is expected.
  void accept(const cmodel::Beat& beat) override;
  void on_raw(const RawTap& tap) override;

  /// Throws UserError (Input) if the stream ended where it may not.
  void end_of_stream() { model_.finish(); }
  /// Ends the check: expected taps that did not come are missing. Compares its counters and, after start(), its cycles.
  CheckReport finish(const cmodel::Counters& counters, const cmodel::StallCounters& cycles);
  /// The same for a device whose counters are not read: neither they nor cycles are compared.
  CheckReport finish();

  /// Too many mismatches, or a device that has gone silent.
  bool stopped() const { return silent_ || board_.mismatches() + mismatches_ >= options_.stop_after; }
  CheckReport report() const;                                            ///< so far
  const cmodel::Counters& counted() const { return model_.counters(); }  ///< the model's, so far

 private:
  struct ModelTiles final : cmodel::PixelSink {
    std::deque<cmodel::TilePixels> tiles;
    void on_tile(cmodel::TilePixels&& tile) override { tiles.push_back(std::move(tile)); }
  };
  struct DeviceTiles final : cmodel::PixelSink {
    explicit DeviceTiles(Checker* checker) : owner(checker) {}
    Checker* owner;
    void on_tile(cmodel::TilePixels&& tile) override { owner->check_tile(std::move(tile)); }
  };
  void check_tile(cmodel::TilePixels&& tile);
  void check_counters(const cmodel::Counters& rtl);
  void check_cycles(const cmodel::StallCounters& rtl);
  void check_verdict(const RawTap& tap);
  void equal(Detector detector, const std::string& what, std::uint64_t model, std::uint64_t rtl);
  void differ(Detector detector, std::string text);
  /// The detector of the first difference so far. If nothing differs yet: `next`.
  std::optional<Detector> first_detector(std::optional<Detector> next) const;

  cmodel::Config config_;
  cmodel::StreamScope scope_;
  CheckOptions options_;
  cmodel::PixelSink& pixels_;
  Scoreboard board_;
  ModelTiles model_tiles_;
  DeviceTiles device_tiles_{this};
  TapAssembly assembly_;
  cmodel::Model model_;
  VerdictCheck verdicts_;
  cmodel::CullLog culls_;  ///< of the open tile; has each answer by the beat for which the cycle model needs it
  std::optional<cmodel::CycleModel> cycle_model_;  ///< from start() on
  std::optional<std::uint64_t> cycles_rtl_, cycles_model_;
  bool silent_ = false;
  std::uint64_t comparisons_ = 0, mismatches_ = 0;  ///< of tiles, counters, cycles and verdicts
  std::optional<Detector> detector_;                ///< of the first difference, once one of those differed
  std::vector<std::string> differences_;
};

}  // namespace fastsplat::testbench
