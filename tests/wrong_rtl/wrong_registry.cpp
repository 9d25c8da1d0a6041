// The RTL of tiny with a lie at one tap: of every seventh splat of a tile the sheet's words come out inverted.
#include "driver/config_file.hpp"
#include "testbench/device/rtl_registry.hpp"
#include "testbench/device/passing_device.hpp"

namespace fastsplat::testbench {

std::unique_ptr<RtlDevice> make_tiny(const cmodel::Config&, cmodel::PixelSink&, const RtlOptions&);

namespace {

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
  RtlOptions told(RtlOptions options) {
    if (options.taps != nullptr) options.taps = &taps;
    return options;
  }
};

class WrongDevice final : private Lies, public PassingDevice {
 public:
  WrongDevice(const cmodel::Config& config, cmodel::PixelSink& pixels, const RtlOptions& given)
      : Lies{LyingTaps(given.taps)}, PassingDevice(make_tiny(config, pixels, told(given))) {}
};

std::unique_ptr<RtlDevice> make_wrong(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                      const RtlOptions& options) {
  return std::make_unique<WrongDevice>(config, pixels, options);
}

}  // namespace

std::span<const RtlEntry> rtl_registry() {
  static const RtlEntry entry{"tiny", cmodel::config_hash(driver::load_config("tiny")), make_wrong};
  return {&entry, 1};
}

}  // namespace fastsplat::testbench
