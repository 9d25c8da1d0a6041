// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cycles/queued_device.hpp"

#include <algorithm>

namespace fastsplat::cmodel {

std::uint64_t QueuedDevice::Arrival::next(std::uint64_t cycle) const {
  const std::uint64_t there = std::max(cycle, at);
  return pattern == nullptr ? there : pattern->next(there);
}

CycleOptions QueuedDevice::with(const CycleOptions& options, const ReadyPattern& arrival, CycleSink& spans) {
  CycleOptions out = options;
  out.input = &arrival;
  out.spans = &spans;
  return out;
}

QueuedDevice::QueuedDevice(const Config& config, std::uint64_t queue_beats, const CycleOptions& options)
    : listener_(options.spans),
      model_(config, StreamScope::Subset, with(options, arrival_, *this)),
      free_(queue_beats) {
  arrival_.pattern = options.input;
}

void QueuedDevice::deal(std::vector<Beat>&& tile) {
  tile_ = std::move(tile);
  sent_ = 0;
}

void QueuedDevice::arrive(const Beat& beat, std::uint64_t cycle) {
  arrival_.at = cycle;
  model_.consume({&beat, 1});
}

void QueuedDevice::on_beat(const BeatCycles& beat) {
  asks_ = free_[place_] = beat.taken + 1;
  place_ = place_ + 1 == free_.size() ? 0 : place_ + 1;
  if (listener_ != nullptr) listener_->on_beat(beat);
}

void QueuedDevice::on_verdict(const VerdictCycles& verdict) {
  if (listener_ != nullptr) listener_->on_verdict(verdict);
}

void QueuedDevice::on_sheet(const SheetCycles& sheet) {
  if (listener_ != nullptr) listener_->on_sheet(sheet);
}

void QueuedDevice::on_tile(const TileCycles& tile) {
  tiles_.push_back(tile.tile);
  longest_tile_ = std::max(longest_tile_, tile.picture_to - tile.begun);
  if (listener_ != nullptr) listener_->on_tile(tile);
}

DeviceCycles QueuedDevice::cycles() const {
  return {.tiles = tiles_,
          .counters = model_.counters(),
          .stalls = model_.stalls(),
          .account = model_.account(),
          .idle = model_.idle_cycles(),
          .end = model_.end_cycle(),
          .longest_tile = longest_tile_,
          .pixel_beats = model_.pixel_beats(),
          .sent = model_.sent()};
}

}  // namespace fastsplat::cmodel
