// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cycles/cycle_cluster.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace fastsplat::cmodel {
namespace {

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

template <class Kind>
bool is(const Record* record) {
  return record != nullptr && std::holds_alternative<Kind>(*record);
}

}  // namespace

CycleCluster::CycleCluster(const Config& config, StreamScope scope, const ClusterOptions& options)
    : decode_(config, scope),
      fetches_(options.device.fetch.has_value()),
      link_(fetches_ ? 0 : options.bytes_per_cycle) {
  for (int i = 0; i < options.devices; ++i)
    devices_.push_back(std::make_unique<QueuedDevice>(config, options.queue_beats, options.device));
  last_ = devices_.size() - 1;
}

void CycleCluster::take(const Beat& beat) {
  const Record* record = decode_.feed(beat);
  const bool ends = is<EndTile>(record) || is<EndFrame>(record);
  tables_ = tables_ && !ends && !is<BeginTile>(record);
  if (tables_) return broadcast(beat);
  arriving_.push_back(beat);
  if (!ends) return;
  undealt_.push_back(std::exchange(arriving_, {}));
  pump();
}

void CycleCluster::broadcast(const Beat& beat) {
  link_.wait_until(devices_.front()->room());  // all devices are alike until the first tile
  const std::uint64_t arrived = link_.carry();
  for (const auto& device : devices_) device->arrive(beat, arrived);
}

bool CycleCluster::deal(std::uint64_t cycle) {
  while (true) {
    QueuedDevice* first = nullptr;
    for (const auto& device : devices_) {
      if (device->wants() || device->asks() > cycle) continue;
      if (first == nullptr || device->asks() < first->asks()) first = device.get();
    }
    if (first == nullptr) return true;
    if (undealt_.empty()) return ended_;
    first->deal(std::move(undealt_.front()));
    undealt_.pop_front();
  }
}

QueuedDevice* CycleCluster::turn(std::uint64_t cycle) {
  for (std::size_t i = 1; i <= devices_.size(); ++i) {
    const std::size_t number = (last_ + i) % devices_.size();
    QueuedDevice& device = *devices_[number];
    if (!device.wants() || device.room() > cycle) continue;
    last_ = number;
    return &device;
  }
  return nullptr;
}

std::uint64_t CycleCluster::wake() const {
  std::uint64_t first = kNever;
  for (const auto& device : devices_) {
    if (device->wants()) first = std::min(first, device->room());
    // A request that comes when no tile is left is never served.
    else if (!ended_ || !undealt_.empty())
      first = std::min(first, device->asks());
  }
  return first;
}

void CycleCluster::pump() {
  if (!link_.limited()) {
    pump_at_once();
    return;
  }
  // Beats sent later arrive at or after the link's cycle, and cause later requests. So all requests up to this cycle
  // are known, and tiles are dealt in their order.
  while (deal(link_.cycle())) {
    if (QueuedDevice* device = turn(link_.cycle())) {
      device->arrive(link_.carry());
      continue;
    }
    const std::uint64_t next = wake();
    if (next == kNever) return;
    link_.wait_until(next);
  }
}

void CycleCluster::pump_at_once() {
  for (; !undealt_.empty(); undealt_.pop_front()) {
    QueuedDevice& first = **std::ranges::min_element(devices_, {}, [](const auto& device) { return device->asks(); });
    const std::uint64_t dealt = first.asks();
    first.deal(std::move(undealt_.front()));
    for (; first.wants(); link_.pass()) first.arrive(std::max(dealt, first.room()));
  }
}

void CycleCluster::finish() {
  decode_.finish();
  ended_ = true;
  pump();
  for (const auto& device : devices_) {
    device->finish();
    done_.push_back(device->cycles());
    counters_ += done_.back().counters;
  }
}

std::uint64_t CycleCluster::frame_cycles() const {
  std::uint64_t end = 0;
  for (const DeviceCycles& device : done_) end = std::max(end, device.end);
  return end;
}

std::uint64_t CycleCluster::beats_in() const {
  if (!fetches_) return link_.beats();
  std::uint64_t beats = 0;
  for (const DeviceCycles& device : done_) beats += device.sent.total();
  return beats;
}

std::uint64_t CycleCluster::pixel_beats() const {
  std::uint64_t beats = 0;
  for (const DeviceCycles& device : done_) beats += device.pixel_beats;
  return beats;
}

}  // namespace fastsplat::cmodel
