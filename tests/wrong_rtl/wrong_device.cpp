// SPDX-License-Identifier: Apache-2.0
// The RTL of tiny with a false tap: every seventh splat of a tile has its sheet words inverted.
#include "testbench/device/passing_device.hpp"
#include "testbench/device/rtl_module.hpp"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {

namespace {

std::unique_ptr<RtlDevice> make_true(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                     const RtlOptions& options) {
  return make_verilated_device(open_rtl(config, {.wave = !options.wave.empty()}, simulator_options(options)), config,
                               pixels, options);
}

class LyingTaps final : public RawTapSink {
 public:
  explicit LyingTaps(RawTapSink* to) : to_(to) {}
  void on_raw(const RawTap& tap) override {
    if (tap.port != RawPort::Sheet || tap.tag % 7 != 6) return to_->on_raw(tap);
    std::vector<std::uint32_t> words(tap.words.begin(), tap.words.end());
    for (auto& word : words) word = ~word;
    RawTap changed = tap;
    changed.words = words;
    to_->on_raw(changed);
  }
  void accept(const cmodel::Beat& beat) override { to_->accept(beat); }

 private:
  RawTapSink* to_;
};

/// Holds the taps for as long as the device lives: a base of the device's own base class.
struct Lies {
  LyingTaps taps;
  RtlOptions tapped(RtlOptions options) {
    if (options.taps != nullptr) options.taps = &taps;
    return options;
  }
};

class WrongDevice final : private Lies, public PassingDevice {
 public:
  WrongDevice(const cmodel::Config& config, cmodel::PixelSink& pixels, const RtlOptions& given)
      : Lies{LyingTaps(given.taps)}, PassingDevice(make_true(config, pixels, tapped(given))) {}
};

}  // namespace

void require_rtl(const cmodel::Config&, const std::vector<RtlAbilities>&, const std::string&) {}

std::unique_ptr<RtlDevice> make_rtl_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                           const RtlOptions& options) {
  return std::make_unique<WrongDevice>(config, pixels, options);
}

}  // namespace fastsplat::testbench
