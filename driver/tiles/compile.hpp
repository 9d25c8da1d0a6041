// SPDX-License-Identifier: Apache-2.0
// A scene compiled for a device: everything but the records themselves, which are made tile by tile on demand, so that
// a long stream is never in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "cmodel/fast/band_walk.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/record_sink.hpp"
#include "driver/tiles/frame_head.hpp"
#include "driver/tiles/render.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

/// Contribution of one tile's records to the report.
struct TileReport {
  std::uint64_t splat_records = 0, saturated_records = 0, sheets = 0;
};

using Hides = std::function<bool(const cmodel::CullBlock& set)>;

DriverReport& operator+=(DriverReport& report, const TileReport& tile);

class CompiledFrame {
 public:
  struct State;

  /// Throws UserError (Usage) if the scene does not fit the configuration. `threads` (0: all cores) and `band_rows`,
  /// the height of a band of draw_band() (rounded up to blocks, 0: a tile), never change the result.
  CompiledFrame(const scene::Scene& scene, const cmodel::Config& config, int threads = 1, int band_rows = 0);
  CompiledFrame(const scene::Scene& scene, FrameHead head, int threads, int band_rows);
  ~CompiledFrame();

  const cmodel::Config& config() const;
  const TileGrid& grid() const;
  /// Number of bands in each tile.
  int bands() const;
  /// begin_frame and the tables.
  std::span<const cmodel::Beat> preamble() const;
  /// begin_tile .. end_tile. Const and without shared state: tiles may be emitted in parallel.
  TileReport emit_tile(int tile, cmodel::RecordSink& sink) const;
  /// The same as beats. With `hides`, a device that has taken all earlier beats reports whether it would hide a set;
  /// the splats of hidden sets are then skipped. The device's words and counters do not change.
  TileReport emit_tile(int tile, const cmodel::BeatSink& sink, const Hides& hides = {}) const;
  /// Draws a band of the tile directly into the fast unit, which then has its words and counters. No records are made,
  /// and a splat's place in the band is computed once instead of once per sheet.
  template <class Word>
  cmodel::fast::BandReport draw_band(int tile, int band, cmodel::fast::TileUnit<Word>& unit) const;
  /// Preamble and all tiles in order: a subset stream, without end_frame. Progress counts tiles.
  DriverReport emit(const cmodel::BeatSink& sink, const Progress& progress = {}) const;
  /// Voxels and tiles. The contributions of tiles are in the result of emit(); callers of emit_tile() add them
  /// themselves.
  DriverReport report() const;
  /// Number of splats that touch each band, tile by tile: an estimate of its work.
  std::vector<std::uint64_t> work() const;

 private:
  std::unique_ptr<const State> state_;
};

}  // namespace fastsplat::driver
