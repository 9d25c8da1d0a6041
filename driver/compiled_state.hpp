// What a compiled frame consists of: for those who emit its tiles or draw them.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/record_sink.hpp"
#include "cmodel/snap.hpp"
#include "cmodel/window_geometry.hpp"
#include "driver/compile.hpp"
#include "driver/projection.hpp"
#include "driver/slices.hpp"
#include "driver/tile_bins.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// The snapped window of a splat in image pixels. The image may be larger than a tile, so positions get room;
/// the tile's origin is a whole number of pixels, so the window is the one the device finds.
class Windows {
 public:
  Windows(const cmodel::Config& config, const RadiusSets& sets) : sets_(sets), snap_(wide(config)) {
    for (std::uint32_t set = 0; set < sets.size(); ++set)
      extents_.push_back(cmodel::window_geometry(config, sets_.rho(set)));
  }
  cmodel::SnappedAxis snapped(std::int32_t centre, std::uint32_t set) const {
    cmodel::Nothing nobody;
    return snap_(centre, sets_.rho(set), nobody);
  }
  Extent operator()(const QuantisedSplat& splat) const {
    const auto extent = static_cast<std::int32_t>(extents_[splat.set].extent);
    const std::int32_t x0 = snapped(splat.x, splat.set).origin, y0 = snapped(splat.y, splat.set).origin;
    return {x0, x0 + extent, y0, y0 + extent, y0 + static_cast<std::int32_t>(extents_[splat.set].padded)};
  }

 private:
  static cmodel::Config wide(cmodel::Config config) {
    config.position_int_bits = 30 - config.position_frac_bits;
    return config;
  }
  const RadiusSets& sets_;
  cmodel::Snap snap_;
  std::vector<cmodel::WindowGeometry> extents_;  ///< per set
};

struct CompiledFrame::State {
  cmodel::Config config;
  cmodel::Mode mode;
  scene::SheetPlan plan;
  Slices slices;
  Projected projected;
  TileGrid grid;
  Bands bands;
  Windows windows;
  TileBins bins;
  int reach = 0;  ///< a splat reaches at most this many sheets beyond its first
  std::vector<cmodel::Beat> preamble;

  State(const scene::Scene& scene, const cmodel::Config& device, int threads, int band_rows);

  bool sliced() const { return plan.use == scene::SheetUse::Sliced; }
  int first_sheet(const QuantisedSplat& splat) const { return sliced() ? slices.first(splat.depth) : splat.depth; }
  Share share(const SplatWords& words, std::int32_t depth, int sheet) const {
    return sliced() ? slices.share(words, depth, sheet) : slices.whole(words);
  }
  cmodel::BeginTile begin_tile(int tile) const {
    return {mode, static_cast<std::uint32_t>(tile), grid.x(tile), grid.y(tile), grid.width(tile), grid.height(tile)};
  }
  cmodel::BeginTile begin_band(int tile, int band) const {
    cmodel::BeginTile out = begin_tile(tile);
    out.y += bands.first_row(band);
    out.height = bands.height(band, out.height);
    return out;
  }
  /// Records of one sheet of one tile; begin_sheet only when there is something to say.
  std::uint32_t emit_sheet(int tile, int sheet, std::uint32_t& tag, cmodel::RecordSink& out, TileReport& report) const;

 private:
  TileBins make_bins(int threads) const;
  void make_preamble(const scene::Scene& scene);
};

}  // namespace fastsplat::driver
