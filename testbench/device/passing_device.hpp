// SPDX-License-Identifier: Apache-2.0
// A device that forwards everything to another: for tests that change one thing on the way.
#pragma once

#include <memory>
#include <utility>

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

class PassingDevice : public RtlDevice {
 public:
  explicit PassingDevice(std::unique_ptr<RtlDevice> device) : device_(std::move(device)) {}
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
  bool takes_half_write(WriteHalf half, std::uint32_t address, std::uint32_t word, int cycles) override {
    return device_->takes_half_write(half, address, word, cycles);
  }
  void leave_answers_waiting(bool read_too) override { device_->leave_answers_waiting(read_too); }
  void warm_reset(int cycles) override { device_->warm_reset(cycles); }
  std::optional<Refusal> refuse(const cmodel::Beat& beat) override { return device_->refuse(beat); }
  void drop(std::span<const cmodel::Beat> beats) override { device_->drop(beats); }
  void soft_reset(bool wait) override { device_->soft_reset(wait); }
  bool interrupt() const override { return device_->interrupt(); }
  bool sliced() const override { return device_->sliced(); }
  std::uint64_t aborted_tiles() const override { return device_->aborted_tiles(); }

 private:
  std::unique_ptr<RtlDevice> device_;
};

}  // namespace fastsplat::testbench
