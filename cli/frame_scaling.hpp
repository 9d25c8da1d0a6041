// SPDX-License-Identifier: Apache-2.0
// `cycles --devices N,.. --bytes-per-cycle B --clock MHZ`: a frame on several devices, and what limits it
// (docs/scaling.md).
#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "cmodel/cycles/cluster_account.hpp"
#include "cmodel/cycles/cycle_cluster.hpp"

namespace fastsplat::cli {

struct ScalingFlags {
  std::vector<int> devices;  ///< numbers of devices, increasing; empty: one
  std::optional<int> bytes_per_cycle;
  std::optional<double> clock;  ///< MHz

  /// Whether any flag was given; scaling is reported only then.
  bool any() const { return !devices.empty() || bytes_per_cycle || clock; }
};

/// --clock MHZ; `help` says what it is for.
void declare_clock(Options& options, std::optional<double>& to, const char* help);
void declare(Options& options, ScalingFlags& to);
/// UserError (Usage) if a timeline is requested for several devices. `timeline`: the flag that requests it, empty for
/// none.
void check(const ScalingFlags& flags, const std::string& timeline);

/// Figures of one frame on `devices` devices. Cycles count from reset; shares are summed over the devices.
struct FrameScaling {
  std::uint64_t devices = 1, bytes_per_cycle = 0;  ///< 0: no limit
  bool fetches = false;                            ///< each device reads memory for itself
  std::optional<double> clock;                     ///< MHz
  std::uint64_t frame = 0, one_device = 0;         ///< cycles: of this frame, and on one device with the same link
  std::uint64_t bytes_in = 0, bytes_out = 0;
  std::uint64_t splats = 0, windows = 0;
  cmodel::FrameShares shares;
  cmodel::Roofline roofline;
  cmodel::CycleAccount account;  ///< summed over the devices
  std::uint64_t wipe = 0;  ///< part of fill: from reset until the first beat is in decode; summed over the devices
  std::vector<cmodel::DeviceCycles> each;

  std::uint64_t device_cycles() const { return devices * frame; }
  double efficiency() const;
  double speed_up() const;
  std::uint64_t longest_tile() const;
};

std::string to_text(const FrameScaling& scaling);
/// A row for each number of devices.
std::string to_table(const std::vector<FrameScaling>& scalings);
nlohmann::ordered_json to_json(const FrameScaling& scaling);

/// Runs the same stream on each requested number of devices, and on one device for comparison.
class ScalingRun final : public cmodel::Device {
 public:
  ScalingRun(const cmodel::Config& config, cmodel::StreamScope scope, const ScalingFlags& flags,
             const cmodel::CycleOptions& options);

  void consume(std::span<const cmodel::Beat> beats) override;
  void finish() override;
  const cmodel::Counters& counters() const override { return clusters_.front().counters(); }

  /// After finish(): the whole frame on a single device.
  const cmodel::DeviceCycles& one_device() const { return clusters_.front().devices().front(); }
  /// After finish(): one entry for each requested number of devices, in that order.
  std::vector<FrameScaling> scalings() const;

 private:
  FrameScaling scaling(const cmodel::CycleCluster& cluster) const;

  cmodel::Config config_;
  std::optional<double> clock_;
  std::uint64_t bytes_per_cycle_;
  bool fetches_, single_asked_for_;
  std::deque<cmodel::CycleCluster> clusters_;  ///< the first has one device
};

}  // namespace fastsplat::cli
