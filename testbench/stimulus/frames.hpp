// SPDX-License-Identifier: Apache-2.0
// Feeds a device one frame after the other, each under a separate checker: valid frames, frames that it has to refuse,
// frames that are abandoned in the middle.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cmodel/io/register_map.hpp"
#include "testbench/check/checker.hpp"
#include "testbench/stimulus/violations.hpp"

namespace fastsplat::testbench {

/// Where the model refuses a stream, as a device does that may be given any tiles.
struct Refused {
  cmodel::StreamRule rule;
  std::size_t beat;
};
std::optional<Refused> refused_by_model(const cmodel::Config& config, const Beats& beats);

/// Number of beats up to and including the end_frame that a device takes; nothing if it takes none.
std::optional<std::size_t> first_end(const cmodel::Config& config, const Beats& beats);

/// Something done between two beats of a frame while the source pauses.
struct Meanwhile {
  std::size_t at = 0;  ///< beats before it
  std::function<void()> what;
};

class Frames {
 public:
  /// `sink`: when pixels are taken. `check` outlives it.
  Frames(const cmodel::Config& config, const MakeDevice& make, Check& check, const Pattern& sink = {});

  RtlDevice& device() { return *device_; }
  std::uint32_t read(const cmodel::Register& reg) { return device_->read_register(reg.address).word; }
  void write(const cmodel::Register& reg, std::uint32_t word) { device_->write_register(reg.address, word); }
  /// Tiles of the current frame whose last pixels were taken.
  int tiles_left() const { return relay_.tiles_left; }

  /// Feeds a legal frame.
  void good(const std::string& what, const Beats& beats, Coverage::Id bin, const Meanwhile& meanwhile = {});
  /// Feeds a frame of which the model refuses a beat. Returns whether the device reacts as it has to; its error stays.
  /// `meanwhile` is done before that beat, while the source pauses.
  bool bad(const std::string& what, const Beats& beats, const Refused& expected, Coverage::Id bin,
           const std::function<void()>& meanwhile = {});
  /// A soft reset behind some beats of a frame, after about `wait` cycles. If a next frame is given, its beats are
  /// offered at once, whatever the reset still has to do.
  void cut(const std::string& what, std::span<const cmodel::Beat> beats, int wait, Coverage::Id bin,
           const Beats& next = {});
  /// A hard reset behind some beats of a frame, after about `wait` cycles.
  void drop(std::span<const cmodel::Beat> beats, int reset_cycles, int wait = 0);
  /// Clears the device's error by a soft reset.
  void forgive();

 private:
  /// The source is always ready, except for its pauses, which come in their order.
  class Source final : public cmodel::ReadyPattern {
   public:
    void begin() { pauses_.clear(); }
    void pause(std::uint64_t from, std::uint64_t to) { pauses_.emplace_back(from, to); }
    std::uint64_t next(std::uint64_t cycle) const override {
      for (const auto& [from, to] : pauses_) {
        if (cycle >= from && cycle < to) cycle = to;
      }
      return cycle;
    }

   private:
    std::vector<std::pair<std::uint64_t, std::uint64_t>> pauses_;
  };

  /// Receives what the device shows and passes it to the checker of the current frame.
  struct Relay final : RawTapSink {
    Checker* to = nullptr;
    Checker* next = nullptr;  ///< takes over with the first beat that is taken
    int tiles_left = 0;
    void on_raw(const RawTap& tap) override {
      if (tap.port == RawPort::Pixels && tap.last) ++tiles_left;
      if (to != nullptr) to->on_raw(tap);
    }
    void accept(const cmodel::Beat& beat) override {
      if (next != nullptr) to = std::exchange(next, nullptr);
      if (to != nullptr) to->accept(beat);
    }
  };

  void begin();
  void pause(const std::function<void()>& meanwhile);
  void end(const std::string& what, Coverage::Id bin, bool in_table);
  /// Behind a soft reset, with the tables or tile of the cut frame closed.
  void follow(const std::string& what, const Beats& next, bool in_table, Coverage::Id bin);
  void record(const std::string& what, const CheckReport& report, Coverage::Id bin);

  cmodel::Config config_;
  Check& check_;
  Pattern sink_;
  cmodel::NullPixels none_;
  Relay relay_;
  Source source_;
  std::unique_ptr<RtlDevice> device_;
  std::optional<Checker> checker_;
};

}  // namespace fastsplat::testbench
