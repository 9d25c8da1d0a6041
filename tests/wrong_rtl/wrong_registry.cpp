// The RTL of tiny with a lie at one tap: of every seventh splat of a tile the sheet's words come out inverted.
#include "driver/config_file.hpp"
#include "testbench/device/rtl_registry.hpp"

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

class WrongDevice final : public RtlDevice {
 public:
  WrongDevice(const cmodel::Config& config, cmodel::PixelSink& pixels, const RtlOptions& given)
      : taps_(given.taps), device_(make_tiny(config, pixels, with_lies(given))) {}
  void consume(std::span<const cmodel::Beat> beats) override { device_->consume(beats); }
  void finish() override { device_->finish(); }
  const cmodel::Counters& counters() const override { return device_->counters(); }
  std::uint64_t cycles() const override { return device_->cycles(); }
  cmodel::StallCounters cycle_counters() override { return device_->cycle_counters(); }
  RegisterAnswer read_register(std::uint32_t address, int wait) override {
    return device_->read_register(address, wait);
  }
  RegisterAnswer write_register(std::uint32_t address, std::uint32_t word, int wait) override {
    return device_->write_register(address, word, wait);
  }
  void warm_reset() override { device_->warm_reset(); }

 private:
  RtlOptions with_lies(RtlOptions options) {
    if (options.taps != nullptr) options.taps = &taps_;
    return options;
  }
  LyingTaps taps_;
  std::unique_ptr<RtlDevice> device_;
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
