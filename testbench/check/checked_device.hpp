// A device under test beside the model and the cycle model, in lock-step, beat by beat: every tap, every pixel, every
// counter and the cycles compared. Memory stays bounded by the device's depth, whatever the stream's length. Knows no
// simulator type.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "testbench/check/scoreboard.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

/// What passed the checker.
struct CheckReport {
  std::uint64_t comparisons = 0;  ///< tap records, pixel words, counters and cycles
  std::uint64_t mismatches = 0;
  std::array<std::uint64_t, cmodel::kTapCount> by_tap{};  ///< records compared
  std::optional<Divergence> first;                        ///< of the taps
  std::vector<std::string> differences;                   ///< tiles, counters and cycles that differ, in words
  /// Busy cycles of the device and of the cycle model; absent of a run that did not reach its end.
  std::optional<std::uint64_t> cycles_rtl, cycles_model;
};

struct CheckOptions {
  std::uint64_t stop_after = 1000;          ///< mismatches; then no more beats are taken
  const cmodel::Willing* source = nullptr;  ///< when beats are offered to the device; null: always
  const cmodel::Willing* sink = nullptr;    ///< when its pixels are taken; null: always
};

class CheckedDevice final : public cmodel::Device {
 public:
  /// Makes the device under test; both sinks outlive it.
  using Factory = std::function<std::unique_ptr<RtlDevice>(cmodel::PixelSink&, cmodel::TapSink&)>;

  /// `pixels` receives the device's tiles (not the model's). What `options` points to outlives the device.
  CheckedDevice(const cmodel::Config& config, cmodel::StreamScope scope, cmodel::PixelSink& pixels, const Factory& make,
                const CheckOptions& options = {});

  void consume(std::span<const cmodel::Beat> beats) override;
  void finish() override;
  const cmodel::Counters& counters() const override { return counters_; }  ///< the device's; valid after finish

  /// Runs `action` with the checker deaf: what the device shows meanwhile (a stream cut off by a reset) is not
  /// compared.
  void unchecked(const std::function<void(RtlDevice&)>& action);

  bool stopped() const { return stopped_; }
  CheckReport report() const;
  RtlDevice& device() { return *device_; }

 private:
  struct ModelTiles final : cmodel::PixelSink {
    std::deque<cmodel::TilePixels> tiles;
    void on_tile(cmodel::TilePixels&& tile) override { tiles.push_back(std::move(tile)); }
  };
  struct DeviceTiles final : cmodel::PixelSink {
    CheckedDevice* owner;
    explicit DeviceTiles(CheckedDevice* device) : owner(device) {}
    void on_tile(cmodel::TilePixels&& tile) override { owner->check_tile(std::move(tile)); }
  };
  struct Gate final : cmodel::TapSink {
    cmodel::TapSink* to = nullptr;
    bool open = true;
    void on_tap(const cmodel::TapRecord& record) override {
      if (open) to->on_tap(record);
    }
  };
  void check_tile(cmodel::TilePixels&& tile);
  void check_counters();
  void check_cycles();
  void equal(const std::string& what, std::uint64_t model, std::uint64_t rtl);
  void differ(std::string text);
  void stop_if_broken();

  cmodel::Config config_;
  cmodel::StreamScope scope_;
  CheckOptions options_;
  cmodel::PixelSink& pixels_;
  Scoreboard board_;
  Gate gate_;
  ModelTiles model_tiles_;
  DeviceTiles device_tiles_{this};
  cmodel::Model model_;
  std::optional<cmodel::CycleModel> cycle_model_;  ///< from the first beat on: the device's clock runs before it
  std::unique_ptr<RtlDevice> device_;
  cmodel::Counters counters_;
  std::optional<std::uint64_t> cycles_rtl_, cycles_model_;
  bool stopped_ = false;
  std::uint64_t comparisons_ = 0, mismatches_ = 0;  ///< of tiles, counters and cycles
  std::vector<std::string> differences_;
};

}  // namespace fastsplat::testbench
