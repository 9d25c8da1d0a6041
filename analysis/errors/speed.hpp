// SPDX-License-Identifier: Apache-2.0
// Frames a second: which array, tile, culling and number of devices reach them with the least area (docs/errors.md,
// section 6). These keys change cycles and area, and no pixel but in perspective.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/errors/area.hpp"
#include "analysis/errors/frame_work.hpp"
#include "base/progress.hpp"
#include "cmodel/cull/terminations.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"

namespace fastsplat::analysis {

/// Cycles of memory latency of the sources that devices with culling fetch from.
inline constexpr int kFetchLatency = 40;
inline constexpr int kMostDevices = 64;

struct SpeedTarget {
  double fps = 0.0;        ///< frames a second of every scene, at least
  double clock_mhz = 0.0;  ///< of all devices
};

/// The keys that change speed only. position.int_bits and rlut.columns follow them.
struct SpeedKeys {
  int lanes = 8, tile_width = 128, tile_height = 128;
  int composited = 64;  ///< pixels composited at once, Config::composited_at_once()
  int cull_map = 0;
  auto operator<=>(const SpeedKeys&) const = default;
  std::string cull_text() const;  ///< "off", "block" or "pixel"
  std::string text() const;  ///< "8x8 lanes, 64 composited at once, tiles of 128x128, culling block"
};
SpeedKeys speed_keys(const cmodel::Config& config);
/// The configuration with these keys; nullopt if that is not valid, or cannot be built in RTL although `config` can.
std::optional<cmodel::Config> arranged(const cmodel::Config& config, const SpeedKeys& keys);
/// All valid ones of: arrays of 1 to 16 lanes a side; square tiles of 16 to 128 pixels and that of `config`; P^2 to
/// P^2 / 16 pixels composited at once. Culling is off, by blocks, or as `config` has it.
std::vector<SpeedKeys> speed_choices(const cmodel::Config& config);

/// In perspective a scene has as many radius sets as its columns have room for, and columns are padded to windows.
bool arrangement_changes_pixels(const scene::Scene& scene);

/// Equal devices that share a frame's tiles.
struct Arrangement {
  SpeedKeys keys;
  int devices = 1;
  std::vector<std::uint64_t> cycles;  ///< of a frame, by scene
  Area area;                          ///< of one device

  double equivalent_luts() const { return devices * area.equivalent_luts(); }  ///< of all devices
  std::uint64_t slowest() const;                                               ///< cycles of the slowest scene
  double fps(double clock_mhz) const;
};

class SpeedSearch {
 public:
  /// Keeps a reference to the scenes. `progress` counts frames.
  SpeedSearch(const std::vector<scene::Scene>& scenes, double clock_mhz, int threads, Progress progress = {});

  /// The least total area with at least `fps` frames a second on every scene. nullopt if not even kMostDevices devices
  /// reach it.
  std::optional<Arrangement> cheapest(const cmodel::Config& config, double fps);
  /// The least number of devices with these keys; nullopt as above.
  std::optional<Arrangement> least_devices(const cmodel::Config& config, const SpeedKeys& keys, double fps);
  int counted() const { return counted_; }  ///< frames whose cycles were counted

 private:
  using Group = std::tuple<int, int, int, int>;  ///< lanes, tile, cull.map
  struct Compiled;                               ///< the scenes for one device

  /// What follows is about this configuration.
  void begin(const cmodel::Config& config);
  /// By scene, of devices that differ in what is composited at once and in widths; empty if a scene cannot be drawn.
  const std::vector<FrameWork>& work(const SpeedKeys& keys);
  /// The least number that is fast enough if frames take `share` of their estimates; kMostDevices + 1: none is.
  int devices_at_least(const SpeedKeys& keys, double fps, double share);
  /// Windows of the slowest scene, at least: from those of 8 x 8 lanes and the largest tile. Smaller tiles cut more
  /// footprints, and narrower arrays pad them less.
  double windows_at_least(const SpeedKeys& keys);
  /// Counted, by scene, the slowest by its estimate first; once one misses the target, others may stay 0. Empty if a
  /// scene cannot be drawn.
  std::vector<std::uint64_t> cycles(const SpeedKeys& keys, const cmodel::Config& device, int devices, double fps);
  /// Counted; stops at a total area of `price`.
  std::optional<Arrangement> counted(const SpeedKeys& keys, double fps, double price);
  const Compiled* compiled(const cmodel::Config& device);

  const std::vector<scene::Scene>& scenes_;
  double clock_mhz_;
  int threads_;
  Progress progress_;
  cmodel::Config config_;
  std::vector<cmodel::Terminations> terminations_;  ///< by scene, of config_; made for culling
  std::map<Group, std::vector<FrameWork>> work_;
  std::map<std::pair<std::uint64_t, int>, std::vector<std::uint64_t>> cycles_;  ///< by hash and number of devices
  std::uint64_t compiled_hash_ = 0;
  std::shared_ptr<const Compiled> compiled_;  ///< the last
  int counted_ = 0;
};

}  // namespace fastsplat::analysis
