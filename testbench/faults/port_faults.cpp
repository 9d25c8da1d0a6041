// SPDX-License-Identifier: Apache-2.0
#include "testbench/faults/port_faults.hpp"

#include <vector>

#include "testbench/device/passing_device.hpp"

namespace fastsplat::testbench {
namespace {

constexpr std::uint32_t kEvery = 7;

class WrongTaps final : public RawTapSink {
 public:
  WrongTaps(PortFault fault, RawTapSink* to) : fault_(fault), to_(to) {}

  void on_raw(const RawTap& tap) override {
    const bool seventh = tap.tag % kEvery == kEvery - 1;
    if (tap.port == RawPort::Composite) ++blocks_;
    const bool second = tap.port == RawPort::Composite && blocks_ == 2;
    if (tap.port == RawPort::Pixels && tap.last) blocks_ = 0;
    RawTap wrong = tap;
    switch (fault_) {
      case PortFault::PORT_SNAP:
        if (tap.port == RawPort::Snap && seventh) wrong.mx ^= 1;
        return to_->on_raw(wrong);
      case PortFault::PORT_FOOTPRINT:
        return flipped(tap, tap.port == RawPort::Window && seventh);
      case PortFault::PORT_SHEET:
        return flipped(tap, tap.port == RawPort::Sheet && seventh);
      case PortFault::PORT_COMPOSITE:
        return flipped(tap, second);
      case PortFault::PORT_PIXEL:
        return flipped(tap, tap.port == RawPort::Pixels && tap.last);
      case PortFault::PORT_LOST:
        if (!second) to_->on_raw(tap);
        return;
      case PortFault::PORT_TWICE:
        if (tap.port == RawPort::Snap && seventh) to_->on_raw(tap);
        return to_->on_raw(tap);
      case PortFault::PORT_COUNTER:
      case PortFault::PORT_CYCLE:
        return to_->on_raw(tap);
    }
  }
  void accept(const cmodel::Beat& beat) override { to_->accept(beat); }

 private:
  void flipped(const RawTap& tap, bool here) {
    if (!here) return to_->on_raw(tap);
    std::vector<std::uint32_t> words(tap.words.begin(), tap.words.end());
    words.front() ^= 1;
    RawTap wrong = tap;
    wrong.words = words;
    to_->on_raw(wrong);
  }

  PortFault fault_;
  RawTapSink* to_;
  std::uint64_t blocks_ = 0;  ///< composited in this tile
};

/// Holds the taps for as long as the device lives: a base of the device's own base class.
struct Ports {
  WrongTaps taps;
  RtlOptions tapped(RtlOptions options) {
    if (options.taps != nullptr) options.taps = &taps;
    return options;
  }
};

class WrongDevice final : private Ports, public PassingDevice {
 public:
  WrongDevice(PortFault fault, MakeHealthy make, const cmodel::Config& config, cmodel::PixelSink& pixels,
              const RtlOptions& options)
      : Ports{WrongTaps(fault, options.taps)}, PassingDevice(make(config, pixels, tapped(options))), fault_(fault) {}

  const cmodel::Counters& counters() const override {
    counters_ = PassingDevice::counters();
    if (fault_ == PortFault::PORT_COUNTER) ++counters_.splats;
    return counters_;
  }
  cmodel::StallCounters cycle_counters() override {
    auto counters = PassingDevice::cycle_counters();
    if (fault_ == PortFault::PORT_CYCLE) ++counters.busy;
    return counters;
  }

 private:
  PortFault fault_;
  mutable cmodel::Counters counters_;
};

}  // namespace

std::unique_ptr<RtlDevice> with_port_fault(PortFault fault, MakeHealthy make, const cmodel::Config& config,
                                           cmodel::PixelSink& pixels, const RtlOptions& options) {
  return std::make_unique<WrongDevice>(fault, make, config, pixels, options);
}

}  // namespace fastsplat::testbench
