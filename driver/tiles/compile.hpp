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
#include "driver/tiles/render.hpp"
#include "driver/tiles/tile_bins.hpp"
#include "scene/capability.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// Whether a frame's samples are composited one by one (modes 4 and 5), not summed in sheets.
bool every_sample(const scene::SceneDescription& description);

/// The sheets that the device takes, whatever the method that makes them; where every sample is composited one holds
/// them all. Of a scene that a device offers.
scene::SheetPlan plan_for_device(const scene::Scene& scene);

/// What a device of this configuration has: all have the methods of sheets, those with ellipses footprints of any
/// shape.
scene::Offers offers(const cmodel::Config& config);

/// Contribution of one tile's records to the report.
struct TileReport {
  std::uint64_t splat_records = 0, saturated_records = 0, sheets = 0;
};

using Hides = std::function<bool(const cmodel::CullBlock& set)>;

DriverReport& operator+=(DriverReport& report, const TileReport& tile);

class CompiledFrame {
 public:
  struct State;

  /// Throws UserError (Usage) where the scene does not fit the configuration. `threads` (0: all cores) and `band_rows`,
  /// the height of what draw_band() draws (rounded up to blocks, 0: a tile), never change the result.
  CompiledFrame(const scene::Scene& scene, const cmodel::Config& config, int threads = 1, int band_rows = 0);
  ~CompiledFrame();

  const cmodel::Config& config() const;
  const TileGrid& grid() const;
  /// Of each tile.
  int bands() const;
  /// begin_frame and the tables.
  std::span<const cmodel::Beat> preamble() const;
  /// begin_tile .. end_tile. Const and without shared state: tiles may be emitted in parallel.
  TileReport emit_tile(int tile, cmodel::RecordSink& sink) const;
  /// The same as beats. With `hides`, a device that has taken all earlier beats reports whether it would hide a set;
  /// the splats of hidden sets are then skipped. The device's words and counters do not change.
  TileReport emit_tile(int tile, const cmodel::BeatSink& sink, const Hides& hides = {}) const;
  /// Draws a band of the tile directly into the fast unit, which then has its words and counters. There are no records,
  /// and a splat's place in the band is computed once, not once a sheet.
  template <class Word>
  cmodel::fast::BandReport draw_band(int tile, int band, cmodel::fast::TileUnit<Word>& unit) const;
  /// Preamble and all tiles in order: a subset stream, without end_frame. Progress counts tiles.
  DriverReport emit(const cmodel::BeatSink& sink, const Progress& progress = {}) const;
  /// Voxels and tiles; what the tiles hold is in what emit() returns, or added to it by those who emit them singly.
  DriverReport report() const;
  /// Splats that touch each band, tile by tile: a measure of the work it makes.
  std::vector<std::uint64_t> work() const;

 private:
  std::unique_ptr<const State> state_;
};

}  // namespace fastsplat::driver
