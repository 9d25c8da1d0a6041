// SPDX-License-Identifier: Apache-2.0
#include "testbench/check/checked_device.hpp"

namespace fastsplat::testbench {
namespace {

/// An RtlDevice reports verdicts.
CheckOptions with_verdicts(CheckOptions options) {
  options.verdicts = true;
  return options;
}

}  // namespace

CheckedDevice::CheckedDevice(const cmodel::Config& config, cmodel::StreamScope scope, cmodel::PixelSink& pixels,
                             const Factory& make, const CheckOptions& options)
    : checker_(config, scope, pixels, with_verdicts(options)), device_(make(none_, gate_)) {}

void CheckedDevice::unchecked(const std::function<void(RtlDevice&)>& action) {
  gate_.open = false;
  action(*device_);
  gate_.open = true;
}

void CheckedDevice::consume(std::span<const cmodel::Beat> beats) {
  // The device's clock ran before the first beat: its configuration was read.
  if (!checker_.started()) checker_.start(device_->cycles(), device_->sliced());
  for (const auto& beat : beats) {
    if (stopped()) return;
    device_->consume({&beat, 1});
  }
}

void CheckedDevice::finish() {
  if (stopped()) return;
  checker_.end_of_stream();
  device_->finish();
  counters_ = device_->counters();
  finished_ = true;
  checker_.finish(counters_, device_->cycle_counters());
}

}  // namespace fastsplat::testbench
