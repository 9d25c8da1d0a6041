// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/frame_rate.hpp"
#include "base/parallel/parallel.hpp"
#include "cmodel/cycles/cycle_cluster.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/cull_log.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;

constexpr int kLeastTile = 16, kMostTile = 128, kMostLanes = 16, kMostSlices = 16;
/// A frame may take this share of its estimate, or more: widths move windows by a phase, and pipes overlap.
constexpr double kSurely = 0.97;
/// Typical number of frames that are counted; for the progress shown.
constexpr std::size_t kUsualFrames = 60;

}  // namespace

std::string SpeedKeys::cull_text() const {
  Config names;
  names.cull_map = cull_map;
  return cmodel::text_of(names, *cmodel::find_key("cull.map"));
}

std::string SpeedKeys::text() const {
  return fmt::format("{0}x{0} lanes, {1} composited at once, tiles of {2}x{3}, culling {4}", lanes, composited,
                     tile_width, tile_height, cull_text());
}

SpeedKeys speed_keys(const Config& config) {
  return {config.lanes, config.tile_width, config.tile_height, config.composited_at_once(), config.cull_map};
}

std::optional<Config> arranged(const Config& config, const SpeedKeys& keys) {
  if (keys == speed_keys(config)) return config;
  Config out = config;
  out.lanes = keys.lanes;
  out.tile_width = keys.tile_width;
  out.tile_height = keys.tile_height;
  out.composite_lanes = keys.composited == keys.lanes * keys.lanes ? 0 : keys.composited;
  out.cull_map = keys.cull_map;
  out.rlut_columns = (config.rlut_columns + keys.lanes - 1) / keys.lanes * keys.lanes;
  out.position_int_bits = 1;
  while ((1 << (out.position_int_bits - 1)) < std::max(out.tile_width, out.tile_height) + out.rlut_columns)
    ++out.position_int_bits;
  if (cmodel::first_violation(out)) return std::nullopt;
  if (cmodel::rtl_violation(out) && !cmodel::rtl_violation(config)) return std::nullopt;
  return out;
}

std::vector<SpeedKeys> speed_choices(const Config& config) {
  std::set<std::pair<int, int>> tiles{{config.tile_width, config.tile_height}};
  for (int side = kLeastTile; side <= kMostTile; side *= 2) tiles.insert({side, side});
  std::set<SpeedKeys> keys{speed_keys(config)};
  for (int lanes = 1; lanes <= kMostLanes; lanes *= 2) {
    const int block = lanes * lanes;
    for (const auto& [width, height] : tiles) {
      for (int composited = block; composited >= 1 && composited >= block / kMostSlices; composited /= 2) {
        for (const int map :
             {static_cast<int>(cmodel::CullMap::Off), static_cast<int>(cmodel::CullMap::Block), config.cull_map})
          keys.insert({lanes, width, height, composited, map});
      }
    }
  }
  std::vector<SpeedKeys> out;
  for (const SpeedKeys& each : keys) {
    if (arranged(config, each)) out.push_back(each);
  }
  return out;
}

double Arrangement::fps(double clock_mhz) const { return frames_per_second(slowest(), clock_mhz); }

std::uint64_t Arrangement::slowest() const { return *std::ranges::max_element(cycles); }

bool arrangement_changes_pixels(const scene::Scene& scene) {
  return scene.description.camera.projection == scene::Projection::Perspective;
}

struct SpeedSearch::Compiled {
  std::vector<std::unique_ptr<const driver::CompiledFrame>> frames;
  std::vector<driver::CullRun> culls;
};

SpeedSearch::SpeedSearch(const std::vector<scene::Scene>& scenes, double clock_mhz, int threads, Progress progress)
    : scenes_(scenes), clock_mhz_(clock_mhz), threads_(threads), progress_(std::move(progress)) {}

void SpeedSearch::begin(const Config& config) {
  if (config == config_) return;
  config_ = config;
  terminations_.clear();
  work_.clear();  // other widths have other tables, and other splats that vanish
}

const SpeedSearch::Compiled* SpeedSearch::compiled(const Config& device) {
  const std::uint64_t hash = cmodel::config_hash(device);
  if (compiled_ && compiled_hash_ == hash) return compiled_.get();
  compiled_.reset();
  auto fresh = std::make_shared<Compiled>();
  try {
    if (device.culls() && terminations_.empty()) {
      for (const scene::Scene& scene : scenes_) terminations_.push_back(driver::terminations(scene, config_, threads_));
    }
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      const scene::Scene& scene = scenes_[i];
      fresh->frames.push_back(std::make_unique<const driver::CompiledFrame>(scene, device, threads_));
      if (!device.culls()) continue;
      fresh->culls.push_back(driver::run_culls(
          *fresh->frames[i],
          arrangement_changes_pixels(scene) ? driver::terminations(scene, device, threads_) : terminations_[i],
          threads_));
    }
  } catch (const UserError&) {
    return nullptr;
  }
  compiled_ = std::move(fresh);
  compiled_hash_ = hash;
  counted_ += static_cast<int>(scenes_.size());
  if (progress_)
    progress_(static_cast<std::size_t>(counted_), std::max(kUsualFrames, static_cast<std::size_t>(counted_) + 1));
  return compiled_.get();
}

const std::vector<FrameWork>& SpeedSearch::work(const SpeedKeys& keys) {
  const auto [found, fresh] = work_.try_emplace({keys.lanes, keys.tile_width, keys.tile_height, keys.cull_map});
  const auto device = arranged(config_, keys);
  std::vector<FrameWork>& out = found->second;
  const Compiled* frames = fresh && device ? compiled(*device) : nullptr;
  if (frames == nullptr) return out;
  out.assign(scenes_.size(), FrameWork(device->slices()));
  parallel_for(scenes_.size(), threads_, [&](std::size_t i) {
    cmodel::CycleOptions options{.spans = &out[i]};
    if (device->culls()) options.culls = &frames->culls[i].log, options.fetch = cmodel::Fetch{kFetchLatency};
    cmodel::CycleModel model(*device, cmodel::StreamScope::Subset, options);
    frames->frames[i]->emit([&](std::span<const cmodel::Beat> beats) { model.consume(beats); });
    model.finish();
    out[i].splats = model.counters().splats;
  });
  return out;
}

int SpeedSearch::devices_at_least(const SpeedKeys& keys, double target, double share) {
  const auto& frames = work(keys);
  const auto fast = [&](int devices) {
    return !frames.empty() && std::ranges::all_of(frames, [&](const FrameWork& frame) {
      return share * target * frame.cycles(devices, keys.lanes * keys.lanes / keys.composited) <= 1e6 * clock_mhz_;
    });
  };
  int devices = 1;
  while (devices <= kMostDevices && !fast(devices)) ++devices;
  return devices;
}

double SpeedSearch::windows_at_least(const SpeedKeys& keys) {
  constexpr double kLanes = 8.0, kTile = kMostTile;
  double most = 0.0;
  for (const FrameWork& frame : work({8, kMostTile, kMostTile, 64, keys.cull_map})) {
    const double windows = frame.work(0), splats = std::max(1.0, static_cast<double>(frame.splats));
    // A footprint's side without padding, at least.
    const double side = std::max(0.0, kLanes * (std::sqrt(windows / splats) - 1.0));
    if (keys.cull_map == 0) {
      const double tiles = (1.0 + side / keys.tile_width) * (1.0 + side / keys.tile_height) /
                           ((1.0 + side / kTile) * (1.0 + side / kTile));
      most = std::max(most, splats * tiles * std::max(1.0, std::pow(side / keys.lanes, 2.0)));
    } else {  // narrower arrays have smaller blocks, which hide more
      const double more = kLanes / keys.lanes, smaller = keys.lanes < 8 ? 0.5 * side / (side + kLanes) : 1.0;
      most = std::max(most, windows * std::pow(more * smaller, 2.0));
    }
  }
  return kSurely * most;
}

std::vector<std::uint64_t> SpeedSearch::cycles(const SpeedKeys& keys, const Config& device, int devices,
                                               double target) {
  const auto [found, fresh] = cycles_.try_emplace({cmodel::config_hash(device), devices});
  std::vector<std::uint64_t>& out = found->second;
  const auto known = [&] { return !out.empty() && std::ranges::find(out, 0U) == out.end(); };
  if (known()) return out;
  const auto& estimates = work(keys);
  const Compiled* frames = compiled(device);
  if (frames == nullptr || estimates.empty()) return {};
  out.resize(scenes_.size());
  const auto count = [&](std::size_t i) {
    if (out[i] > 0) return;
    cmodel::ClusterOptions options{.devices = devices};
    if (device.culls())
      options.device.culls = &frames->culls[i].log, options.device.fetch = cmodel::Fetch{kFetchLatency};
    cmodel::CycleCluster cluster(device, cmodel::StreamScope::Subset, options);
    frames->frames[i]->emit([&](std::span<const cmodel::Beat> beats) { cluster.consume(beats); });
    cluster.finish();
    out[i] = cluster.frame_cycles();
  };
  std::vector<std::pair<double, std::size_t>> order;  // the slowest by its estimate first
  for (std::size_t i = 0; i < scenes_.size(); ++i)
    order.emplace_back(-estimates[i].cycles(devices, device.slices()), i);
  std::ranges::sort(order);
  std::atomic<bool> slow = false;
  parallel_for(order.size(), threads_, [&](std::size_t n) {
    const std::size_t i = order[n].second;
    if (slow) return;
    count(i);
    if (frames_per_second(out[i], clock_mhz_) < target) slow = true;
  });
  return out;
}

std::optional<Arrangement> SpeedSearch::counted(const SpeedKeys& keys, double target, double price) {
  const Config device = *arranged(config_, keys);
  Arrangement out{.keys = keys, .devices = 0, .cycles = {}, .area = area(device)};
  std::optional<Arrangement> found;
  const auto attempt = [&](int devices) {
    out.devices = devices;
    out.cycles = cycles(keys, device, devices, target);
    const bool fast = !out.cycles.empty() && out.fps(clock_mhz_) >= target;
    if (fast) found = out;
    return fast;
  };
  // The estimate is mostly right: from there on, down or up.
  const int least = devices_at_least(keys, target, kSurely);
  int devices = std::max(least, devices_at_least(keys, target, 1.0));
  const auto too_much = [&](int number) {
    return number > kMostDevices || number * out.area.equivalent_luts() >= price;
  };
  if (too_much(least)) return std::nullopt;
  while (too_much(devices)) --devices;
  if (attempt(devices)) {
    while (devices > least && attempt(devices - 1)) --devices;
  } else {
    while (!out.cycles.empty() && !too_much(devices + 1) && !attempt(++devices)) {
    }
  }
  return found;
}

std::optional<Arrangement> SpeedSearch::least_devices(const Config& config, const SpeedKeys& keys, double target) {
  begin(config);
  return arranged(config, keys) ? counted(keys, target, std::numeric_limits<double>::infinity()) : std::nullopt;
}

std::optional<Arrangement> SpeedSearch::cheapest(const Config& config, double target) {
  begin(config);
  struct Choice {
    SpeedKeys keys;
    double area;  ///< of one device
    int known = 0;
    double bound = area;
  };
  std::vector<Choice> choices;
  for (const SpeedKeys& keys : speed_choices(config))
    choices.push_back({.keys = keys, .area = area(*arranged(config, keys)).equivalent_luts()});
  std::optional<Arrangement> best;
  double price = std::numeric_limits<double>::infinity();
  while (!choices.empty()) {
    const auto next = std::ranges::min_element(choices, {}, &Choice::bound);
    if (next->bound >= price) break;
    // One device; then as many as the windows need; then the estimate; then counted.
    switch (next->known++) {
      case 0:
        next->bound = next->area * std::max(1.0, std::ceil(windows_at_least(next->keys) * target / (1e6 * clock_mhz_)));
        break;
      case 1: {
        const int devices = devices_at_least(next->keys, target, kSurely);
        next->bound = devices > kMostDevices ? price : next->area * devices;
        break;
      }
      default:
        if (const auto found = counted(next->keys, target, price)) best = found, price = found->equivalent_luts();
        choices.erase(next);
    }
  }
  return best;
}

}  // namespace fastsplat::analysis
