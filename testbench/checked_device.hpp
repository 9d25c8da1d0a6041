// A device under test beside the model, in lock-step, beat by beat: every tap, every pixel and every counter compared.
// Memory stays bounded by the device's depth, whatever the stream's length. Knows no simulator type.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cmodel/device.hpp"
#include "cmodel/model.hpp"
#include "testbench/scoreboard.hpp"

namespace fastsplat::testbench {

/// What passed the checker.
struct CheckReport {
  std::uint64_t comparisons = 0;  ///< tap records, pixel words and counters
  std::uint64_t mismatches = 0;
  std::array<std::uint64_t, cmodel::kTapCount> by_tap{};  ///< records compared
  std::optional<Divergence> first;                        ///< of the taps
  std::vector<std::string> differences;                   ///< tiles and counters that differ, in words
};

class CheckedDevice final : public cmodel::Device {
 public:
  /// Makes the device under test; both sinks outlive it.
  using Factory = std::function<std::unique_ptr<cmodel::Device>(cmodel::PixelSink&, cmodel::TapSink&)>;

  /// `pixels` receives the device's tiles (not the model's). Stops taking beats after `stop_after` mismatches.
  CheckedDevice(const cmodel::Config& config, cmodel::StreamScope scope, cmodel::PixelSink& pixels, const Factory& make,
                std::uint64_t stop_after = 1000);

  void consume(std::span<const cmodel::Beat> beats) override;
  void finish() override;
  const cmodel::Counters& counters() const override { return counters_; }  ///< the device's; valid after finish

  /// Runs `action` with the checker deaf: what the device shows meanwhile (a stream cut off by a reset) is not
  /// compared.
  void unchecked(const std::function<void(cmodel::Device&)>& action);

  bool stopped() const { return stopped_; }
  CheckReport report() const;
  cmodel::Device& device() { return *device_; }

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
  void differ(std::string text);
  void stop_if_broken();

  cmodel::PixelSink& pixels_;
  Scoreboard board_;
  Gate gate_;
  ModelTiles model_tiles_;
  DeviceTiles device_tiles_{this};
  cmodel::Model model_;
  std::unique_ptr<cmodel::Device> device_;
  cmodel::Counters counters_;
  std::uint64_t stop_after_;
  bool stopped_ = false;
  std::uint64_t comparisons_ = 0, mismatches_ = 0;  ///< of tiles and counters
  std::vector<std::string> differences_;
};

}  // namespace fastsplat::testbench
