// SPDX-License-Identifier: Apache-2.0
// One of several devices: the cycle model with a queue of arrived beats and the tile dealt to it (docs/scaling.md).
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"

namespace fastsplat::cmodel {

/// Results of one device for a frame. Cycles count from reset.
struct DeviceCycles {
  std::vector<std::uint32_t> tiles;  ///< numbers, in the order dealt
  Counters counters;                 ///< as in CycleModel::counters()
  StallCounters stalls;
  CycleAccount account;            ///< sums to stalls.busy
  std::uint64_t idle = 0;          ///< before `end`, and not busy
  std::uint64_t end = 0;           ///< the first cycle from which it has nothing to do
  std::uint64_t longest_tile = 0;  ///< cycles from begin_tile carried out to the last pixel taken
  std::uint64_t pixel_beats = 0;
  StreamBeats sent;  ///< of its tiles and the tables; a fetching source leaves some out
};

/// Arrivals must come in the order of the beats and never decrease.
class QueuedDevice final : private CycleSink {
 public:
  /// `queue_beats` >= 1. `options` as for a CycleModel; its input pattern applies to beats that have arrived.
  QueuedDevice(const Config& config, std::uint64_t queue_beats, const CycleOptions& options);
  QueuedDevice(const QueuedDevice&) = delete;
  QueuedDevice& operator=(const QueuedDevice&) = delete;

  /// The cycle in which the device requests a tile, once all beats of the last one were sent. No tile is dealt earlier.
  std::uint64_t asks() const { return asks_; }
  /// Deals all beats of a tile, or end_frame.
  void deal(std::vector<Beat>&& tile);
  /// Whether a beat of its tile is still to be sent.
  bool wants() const { return sent_ < tile_.size(); }
  /// The first cycle in which the queue has a place for its next beat.
  std::uint64_t room() const { return free_[place_]; }
  /// The next beat of its tile has arrived.
  void arrive(std::uint64_t cycle) { arrive(tile_[sent_++], cycle); }
  /// A broadcast beat has arrived.
  void arrive(const Beat& beat, std::uint64_t cycle);

  void finish() { model_.finish(); }
  /// After finish().
  DeviceCycles cycles() const;

 private:
  /// The source as decode sees it: the next beat is offered from `at` on, in the pattern's ready cycles.
  struct Arrival final : ReadyPattern {
    std::uint64_t at = 0;
    const ReadyPattern* pattern = nullptr;
    std::uint64_t next(std::uint64_t cycle) const override;
  };

  void on_beat(const BeatCycles& beat) override;
  void on_verdict(const VerdictCycles& verdict) override;
  void on_sheet(const SheetCycles& sheet) override;
  void on_tile(const TileCycles& tile) override;
  static CycleOptions with(const CycleOptions& options, const ReadyPattern& arrival, CycleSink& spans);

  CycleSink* listener_;  ///< may be null
  Arrival arrival_;
  CycleModel model_;
  std::vector<Beat> tile_;
  std::size_t sent_ = 0;             ///< beats of tile_ sent
  std::vector<std::uint64_t> free_;  ///< per place of the queue: cycle from which it is free
  std::size_t place_ = 0;            ///< place of the next beat
  std::uint64_t asks_ = 0;
  std::vector<std::uint32_t> tiles_;
  std::uint64_t longest_tile_ = 0;
};

}  // namespace fastsplat::cmodel
