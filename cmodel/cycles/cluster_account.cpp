// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cycles/cluster_account.hpp"

#include "cmodel/cycles/cycle_stages.hpp"

namespace fastsplat::cmodel {
namespace {

constexpr std::uint64_t up(std::uint64_t whole, std::uint64_t by) { return (whole + by - 1) / by; }

}  // namespace

FrameShares frame_shares(const Config& config, const CycleCluster& cluster) {
  // The first beat is taken in the cycle after the wipe at the earliest, is checked, and lies in decode one later.
  const std::uint64_t start = wipe_cycles(config) + stages::kWeigh + stages::kResult + 1;
  const std::uint64_t frame = cluster.frame_cycles();
  FrameShares shares;
  for (const DeviceCycles& device : cluster.devices()) {
    const CycleAccount& account = device.account;
    shares.work += account.ideal;
    shares.fill += start + account.table_load + account.records + account.sheet_buffer + account.drain +
                   account.hazard + account.hidden + account.map;
    shares.bandwidth += account.input + device.idle - start;
    shares.pixel_out += account.pixels + account.output;
    shares.tail += frame - device.end;
  }
  return shares;
}

Roofline roofline(const Config& config, const CycleCluster& cluster, std::uint64_t bytes_per_cycle) {
  const auto devices = static_cast<std::uint64_t>(cluster.devices().size());
  const auto slices = static_cast<std::uint64_t>(config.slices());
  const Counters& counters = cluster.counters();
  return {.lanes = up(counters.windows, devices),
          .compositor = up(counters.dirty_blocks * slices, devices),
          .stream = bytes_per_cycle == 0 ? 0 : up(cluster.beats_in() * kBeatBytes, bytes_per_cycle),
          .pixel_out = up(cluster.pixel_beats(), devices)};
}

}  // namespace fastsplat::cmodel
