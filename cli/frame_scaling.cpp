#include "cli/frame_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace fastsplat::cli {
namespace {

constexpr double kMostMhz = 100'000.0;

cmodel::ClusterOptions cluster_options(int devices, const ScalingFlags& flags, const cmodel::CycleOptions& options) {
  cmodel::ClusterOptions out;
  out.devices = devices;
  out.bytes_per_cycle = static_cast<std::uint64_t>(flags.bytes_per_cycle.value_or(0));
  out.device = options;
  return out;
}

}  // namespace

void declare(Options& options, ScalingFlags& to) {
  options.integer("--devices", to.devices, 1, 64, "N", "equal devices that the tiles are dealt to");
  options.integer("--bytes-per-cycle", to.bytes_per_cycle, 0, 65536, "B",
                  "of the stream, to all devices together; a beat has 24; 0: no limit");
  options.value(
      "--clock",
      [](std::string& text) -> std::string {
        const auto number = number_from(text);
        if (number && *number > 0.0 && *number <= kMostMhz) return {};
        return fmt::format("expected a number above 0, up to {}, got '{}'", kMostMhz, text);
      },
      [&to](const std::string& text) { to.clock = *number_from(text); }, "MHZ",
      "clock of the devices: time and frames per second");
}

void check(const ScalingFlags& flags, const std::string& trace) {
  if (flags.devices.value_or(1) == 1 || trace.empty()) return;
  throw_usage({.where = "--trace",
               .what = "a timeline is drawn of one device",
               .expected = "--devices 1",
               .got = fmt::format("--devices {}", *flags.devices),
               .fix = "leave out --devices or --trace"});
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
      cluster_(config, scope, cluster_options(flags.devices.value_or(1), flags, options)) {
  if (flags.devices.value_or(1) > 1) single_.emplace(config, scope, cluster_options(1, flags, options));
}

void ScalingRun::consume(std::span<const cmodel::Beat> beats) {
  cluster_.consume(beats);
  if (single_) single_->consume(beats);
}

void ScalingRun::finish() {
  cluster_.finish();
  if (single_) single_->finish();
}

FrameScaling ScalingRun::scaling() const {
  FrameScaling out;
  out.each = cluster_.devices();
  out.devices = out.each.size();
  out.bytes_per_cycle = bytes_per_cycle_;
  out.clock = clock_;
  out.frame = cluster_.frame_cycles();
  out.one_device = single_ ? single_->frame_cycles() : out.frame;
  out.bytes_in = cluster_.beats_in() * cmodel::kBeatBytes;
  out.bytes_out = cluster_.pixel_beats() * static_cast<std::uint64_t>(config_.lanes) * 16;
  out.splats = cluster_.counters().splats;
  out.windows = cluster_.counters().windows;
  out.shares = cmodel::frame_shares(config_, cluster_);
  out.roofline = cmodel::roofline(cluster_, bytes_per_cycle_);
  for (const auto& device : out.each) out.account += device.account;
  out.wipe = out.devices * (cmodel::wipe_cycles(config_) + 1);
  return out;
}

}  // namespace fastsplat::cli
