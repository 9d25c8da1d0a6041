// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/cull_log.hpp"

#include <algorithm>
#include <compare>
#include <mutex>
#include <utility>
#include <variant>

#include "base/parallel/parallel.hpp"
#include "cmodel/cull/cull_tests.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/splat/snap.hpp"
#include "driver/tiles/render.hpp"

namespace fastsplat::driver {
namespace {

using cmodel::Config, cmodel::Terminations;

/// A device that only tests: what it would composite is known.
class Tester {
 public:
  Tester(const Config& config, const Terminations& known, cmodel::CullLog& log)
      : config_(config), known_(known), decode_(config, cmodel::StreamScope::Subset), snap_(config), tests_(config) {
    tests_.log(&log);
    extents_.resize(static_cast<std::size_t>(config.rlut_sets));
  }
  void consume(std::span<const cmodel::Beat> beats) {
    for (const cmodel::Beat& beat : beats) {
      if (const cmodel::Record* record = decode_.feed(beat)) std::visit([&](const auto& one) { take(one); }, *record);
    }
  }
  bool would_hide(const cmodel::CullBlock& set) const { return tests_.would_hide(set); }
  const cmodel::CullCounts& culls() const { return tests_.counts(); }

 private:
  struct Set {
    std::uint32_t rho = 0, windows = 0;
  };

  void take(const cmodel::BeginFrame&) {}
  void take(const cmodel::EndFrame&) {}
  void take(const cmodel::LoadTable& table) {
    if (table.table != cmodel::Table::Rlut) return;
    const auto padded = static_cast<std::uint32_t>(cmodel::window_geometry(config_, table.radius.rho).padded);
    extents_[table.radius.set] = {table.radius.rho, padded / static_cast<std::uint32_t>(config_.lanes)};
  }
  void take(const cmodel::BeginTile& tile) {
    tests_.begin_tile(tile);
    changes_.clear();
    if (!tests_.on()) return;
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        const std::uint32_t sheet = known_.at(tile.x + x, tile.y + y);
        if (sheet != Terminations::kNever) changes_.push_back({sheet, y / config_.lanes, x / config_.lanes});
      }
    }
    std::ranges::sort(changes_);
    changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
    next_ = 0;
    tile_ = tile;
  }
  void take(const cmodel::BeginSheet& sheet) {
    sheet_ = sheet.sheet;
    tests_.begin_sheet();
  }
  void take(const cmodel::CullBlock& set) { tests_.cull_block(set); }
  void take(const cmodel::SplatRecord& splat) {
    if (tests_.dropped(splat.tag)) return;
    const Set& set = extents_[splat.set];
    const std::int32_t x = snap_(splat.x, set.rho).origin, y = snap_(splat.y, set.rho).origin;
    if (!tests_.hidden(x, y, set.windows, set.windows)) tests_.test_windows(x, y, set.windows, set.windows);
  }
  void take(const cmodel::EllipseRecord& splat) {
    if (tests_.dropped(splat.tag)) return;
    tests_.hidden(cmodel::ellipse_axis(config_, splat.x, splat.windows.left).origin,
                  cmodel::ellipse_axis(config_, splat.y, splat.windows.top).origin, splat.windows.columns,
                  splat.windows.rows);
  }
  void take(const cmodel::EndSheet&) {
    // Blocks without a pixel that ended in this sheet stay as they are.
    for (; next_ < changes_.size() && changes_[next_].sheet <= sheet_; ++next_) {
      tests_.composited(changes_[next_].column, changes_[next_].row,
                        [&](int x, int y) { return known_.at(tile_.x + x, tile_.y + y) <= sheet_; });
    }
    tests_.end_sheet();
  }
  void take(const cmodel::EndTile&) {}

  /// A block some of whose pixels end in a sheet.
  struct Change {
    std::uint32_t sheet;
    int row, column;
    auto operator<=>(const Change&) const = default;
  };

  const Config& config_;
  const Terminations& known_;
  cmodel::StreamDecode decode_;
  cmodel::Snap snap_;
  cmodel::CullTests tests_;
  std::vector<Set> extents_;
  cmodel::BeginTile tile_;
  std::uint32_t sheet_ = 0;
  std::vector<Change> changes_;  ///< of the tile, by sheet
  std::size_t next_ = 0;
};

}  // namespace

Terminations terminations(const scene::Scene& scene, const Config& config, int threads) {
  Terminations out(scene.description.width, scene.description.height);
  Config draws = config;
  draws.cull_map = static_cast<int>(cmodel::CullMap::Off);
  render(scene, draws, {.threads = threads, .counters = false, .terminations = &out});
  return out;
}

CullRun run_culls(const CompiledFrame& compiled, const Terminations& terminations, int threads,
                  const Progress& progress) {
  CullRun out;
  if (!compiled.config().culls()) return out;
  const auto tiles = static_cast<std::size_t>(compiled.grid().count());
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(compiled.work(), threads, [&](std::size_t number) {
    cmodel::CullLog log;
    Tester device(compiled.config(), terminations, log);
    device.consume(compiled.preamble());
    compiled.emit_tile(
        static_cast<int>(number), [&](std::span<const cmodel::Beat> beats) { device.consume(beats); },
        [&](const cmodel::CullBlock& set) { return device.would_hide(set); });
    const std::lock_guard lock(mutex);
    out.log.merge(std::move(log));
    out.counts += device.culls();
    if (progress) progress(++done, tiles);
  });
  return out;
}

}  // namespace fastsplat::driver
