// SPDX-License-Identifier: Apache-2.0
// The clock cycles of several devices that share a frame's tiles and one stream link (docs/scaling.md). Like the cycle
// model of one device, it goes by records and computes no pixels.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/cycles/queued_device.hpp"
#include "cmodel/cycles/stream_link.hpp"

namespace fastsplat::cmodel {

struct ClusterOptions {
  int devices = 1;                    ///< >= 1
  std::uint64_t bytes_per_cycle = 0;  ///< of the link, in all; 0: no limit, as with device.fetch
  std::uint64_t queue_beats = 512;    ///< before each device's decode; >= 1
  CycleOptions device{};              ///< of each device; taps and spans receive events of all devices mixed
};

/// A single device on an unlimited link has the counts of a CycleModel. A tile is in memory from its first beat until
/// it is sent: at most one tile more than there are devices.
class CycleCluster final : public Device {
 public:
  /// The objects of `options` must outlive it.
  CycleCluster(const Config& config, StreamScope scope, const ClusterOptions& options);

  void consume(std::span<const Beat> beats) override {
    for (const Beat& beat : beats) take(beat);
  }
  void finish() override;
  /// Of all devices together, after finish().
  const Counters& counters() const override { return counters_; }

  // After finish():
  /// One for each device.
  const std::vector<DeviceCycles>& devices() const { return done_; }
  /// Cycles from reset until all devices are done.
  std::uint64_t frame_cycles() const;
  /// Beats the link carried; a broadcast one counts once. Of devices that fetch, beats that were fetched.
  std::uint64_t beats_in() const;
  /// Beats of pixels, P pixels each, of all devices.
  std::uint64_t pixel_beats() const;

 private:
  void take(const Beat& beat);
  void broadcast(const Beat& beat);
  /// Deals and sends until the result may depend on beats to come.
  void pump();
  /// The same for a link without limit: a beat arrives as soon as its device has room, whatever the others get.
  void pump_at_once();
  /// Deals tiles to the devices that requested one up to `cycle`; false if one is due that has not arrived.
  bool deal(std::uint64_t cycle);
  /// The device whose beat the link begins in `cycle`; nullptr for none.
  QueuedDevice* turn(std::uint64_t cycle);
  /// The next cycle with a tile to deal or a beat to send; kNever without one.
  std::uint64_t wake() const;

  StreamDecode decode_;
  bool fetches_;  ///< each device for itself: the link has no limit
  StreamLink link_;
  std::vector<std::unique_ptr<QueuedDevice>> devices_;
  std::size_t last_ = 0;                   ///< device served last
  bool tables_ = true;                     ///< no tile was begun yet
  bool ended_ = false;                     ///< the stream has ended
  std::vector<Beat> arriving_;             ///< beats of the open tile
  std::deque<std::vector<Beat>> undealt_;  ///< whole tiles, in stream order; finally end_frame
  Counters counters_;
  std::vector<DeviceCycles> done_;
};

}  // namespace fastsplat::cmodel
