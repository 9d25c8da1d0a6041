// SPDX-License-Identifier: Apache-2.0
// A device under test that is checked while it works: drives it beat by beat and reports to the checker what it takes
// and shows.
#pragma once

#include <functional>
#include <memory>

#include "testbench/check/checker.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

class CheckedDevice final : public cmodel::Device {
 public:
  /// Makes the device under test; both sinks outlive it. Its raw taps are checked, its tiles are made from them.
  using Factory = std::function<std::unique_ptr<RtlDevice>(cmodel::PixelSink&, RawTapSink&)>;

  /// `pixels` receives the device's tiles (not the model's). What `options` points to outlives the device.
  CheckedDevice(const cmodel::Config& config, cmodel::StreamScope scope, cmodel::PixelSink& pixels, const Factory& make,
                const CheckOptions& options = {});

  void consume(std::span<const cmodel::Beat> beats) override;
  void finish() override;
  /// The device's once it has come to rest; of a run stopped before, the model's for the same beats.
  const cmodel::Counters& counters() const override { return finished_ ? counters_ : checker_.counted(); }

  /// Runs `action` with the checker disconnected: what the device takes and shows meanwhile (a stream cut off by a
  /// reset) is not compared. Only before the first beat.
  void unchecked(const std::function<void(RtlDevice&)>& action);

  bool stopped() const { return checker_.stopped(); }
  CheckReport report() const { return checker_.report(); }
  RtlDevice& device() { return *device_; }

 private:
  /// Passes everything on while it is open.
  class Gate final : public RawTapSink {
   public:
    explicit Gate(RawTapSink& to) : to_(to) {}
    bool open = true;
    void on_raw(const RawTap& tap) override {
      if (open) to_.on_raw(tap);
    }
    void accept(const cmodel::Beat& beat) override {
      if (open) to_.accept(beat);
    }

   private:
    RawTapSink& to_;
  };

  Checker checker_;
  Gate gate_{checker_};
  cmodel::NullPixels none_;
  std::unique_ptr<RtlDevice> device_;
  cmodel::Counters counters_;
  bool finished_ = false;
};

}  // namespace fastsplat::testbench
