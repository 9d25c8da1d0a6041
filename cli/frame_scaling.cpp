// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_scaling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "base/error.hpp"

namespace fastsplat::cli {
namespace {

constexpr double kMostMhz = 100'000.0;
constexpr int kMostDevices = 64;

/// Parses "1,2,8"; empty for an invalid list.
std::optional<std::vector<int>> devices_from(const std::string& text) {
  std::vector<int> out;
  std::istringstream words(text + ",");
  for (std::string word; std::getline(words, word, ',');) {
    const auto number = integer_from<int>(word);
    if (!number || *number > kMostDevices || *number <= (out.empty() ? 0 : out.back())) return std::nullopt;
    out.push_back(*number);
  }
  return out;
}

cmodel::ClusterOptions cluster_options(int devices, const ScalingFlags& flags, const cmodel::CycleOptions& options) {
  cmodel::ClusterOptions out;
  out.devices = devices;
  out.bytes_per_cycle = static_cast<std::uint64_t>(flags.bytes_per_cycle.value_or(0));
  out.device = options;
  return out;
}

}  // namespace

void declare_clock(Options& options, std::optional<double>& to, const char* help) {
  options.value(
      "--clock",
      [](std::string& text) -> std::string {
        const auto number = number_from(text);
        if (number && *number > 0.0 && *number <= kMostMhz) return {};
        return fmt::format("expected a number above 0, up to {}, got '{}'", kMostMhz, text);
      },
      [&to](const std::string& text) { to = *number_from(text); }, "MHZ", help);
}

void declare(Options& options, ScalingFlags& to) {
  options.value(
      "--devices",
      [](std::string& text) -> std::string {
        if (devices_from(text)) return {};
        return fmt::format("expected an integer from 1 to {}, or an increasing list such as 1,2,4, got '{}'",
                           kMostDevices, text);
      },
      [&to](const std::string& text) { to.devices = *devices_from(text); }, "N[,N...]",
      "number of equal devices that share the tiles; a list prints a table, and details of its last number");
  static const std::string bytes_help = fmt::format(
      "bandwidth of the stream to all devices together; a beat has {} bytes; 0: no limit", cmodel::kBeatBytes);
  options.integer("--bytes-per-cycle", to.bytes_per_cycle, 0, 65536, "B", bytes_help.c_str());
  declare_clock(options, to.clock, "clock of the devices; prints time and frames per second");
}

void check(const ScalingFlags& flags, const std::string& timeline) {
  if (flags.devices.empty() || flags.devices.back() == 1 || timeline.empty()) return;
  throw_usage({.where = timeline,
               .what = "a timeline shows one device only",
               .expected = "--devices 1",
               .got = fmt::format("--devices {}", fmt::join(flags.devices, ",")),
               .fix = "leave out --devices or " + timeline});
}

double FrameScaling::efficiency() const {
  return static_cast<double>(shares.work) / static_cast<double>(device_cycles());
}

double FrameScaling::speed_up() const { return static_cast<double>(one_device) / static_cast<double>(frame); }

std::uint64_t FrameScaling::longest_tile() const {
  std::uint64_t longest = 0;
  for (const auto& device : each) longest = std::max(longest, device.longest_tile);
  return longest;
}

ScalingRun::ScalingRun(const cmodel::Config& config, cmodel::StreamScope scope, const ScalingFlags& flags,
                       const cmodel::CycleOptions& options)
    : config_(config),
      clock_(flags.clock),
      bytes_per_cycle_(static_cast<std::uint64_t>(flags.bytes_per_cycle.value_or(0))),
      fetches_(options.fetch.has_value()),
      single_asked_for_(flags.devices.empty() || flags.devices.front() == 1) {
  clusters_.emplace_back(config, scope, cluster_options(1, flags, options));
  for (const int devices : flags.devices) {
    if (devices > 1) clusters_.emplace_back(config, scope, cluster_options(devices, flags, options));
  }
}

void ScalingRun::consume(std::span<const cmodel::Beat> beats) {
  for (auto& cluster : clusters_) cluster.consume(beats);
}

void ScalingRun::finish() {
  for (auto& cluster : clusters_) cluster.finish();
}

std::vector<FrameScaling> ScalingRun::scalings() const {
  std::vector<FrameScaling> out;
  for (const auto& cluster : clusters_) {
    if (single_asked_for_ || &cluster != &clusters_.front()) out.push_back(scaling(cluster));
  }
  return out;
}

FrameScaling ScalingRun::scaling(const cmodel::CycleCluster& cluster) const {
  FrameScaling out;
  out.each = cluster.devices();
  out.devices = out.each.size();
  out.bytes_per_cycle = bytes_per_cycle_;
  out.fetches = fetches_;
  out.clock = clock_;
  out.frame = cluster.frame_cycles();
  out.one_device = clusters_.front().frame_cycles();
  out.bytes_in = cluster.beats_in() * cmodel::kBeatBytes;
  out.bytes_out = cluster.pixel_beats() * static_cast<std::uint64_t>(config_.lanes) * cmodel::kPixelBytes;
  out.splats = cluster.counters().splats;
  out.windows = cluster.counters().windows;
  out.shares = cmodel::frame_shares(config_, cluster);
  out.roofline = cmodel::roofline(config_, cluster, bytes_per_cycle_);
  for (const auto& device : out.each) out.account += device.account;
  out.wipe = out.devices * (cmodel::wipe_cycles(config_) + 1);
  return out;
}

}  // namespace fastsplat::cli
