// SPDX-License-Identifier: Apache-2.0
// The parts of a compiled frame, for the code that emits or draws its tiles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/stream/record_sink.hpp"
#include "driver/splats/projection.hpp"
#include "driver/splats/slices.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/frame_head.hpp"
#include "driver/tiles/tile_bins.hpp"
#include "driver/tiles/windows.hpp"

namespace fastsplat::driver {

/// A cull group of one cell, two neighbours, or four.
struct CellSet {
  cmodel::CullBlock block;  ///< holds all windows of any splats of the cells; tag and splats not set yet
  std::vector<int> cells;   ///< row by row
};
struct SheetSets {
  std::vector<CellSet> sets;
  std::vector<int> others;  ///< ungrouped cells with splats
};

struct CompiledFrame::State : FrameHead {
  Projected projected;
  Bands bands;
  Windows windows;
  Cells cells;
  TileBins bins;
  DepthGrowth growth(std::uint32_t number) const { return slices.growth(projected.ellipses[number].shrink); }
  int reach = 0;  ///< a splat reaches at most this many sheets beyond its first

  State(const scene::Scene& scene, FrameHead head, int threads, int band_rows);

  bool shaped() const { return !projected.ellipses.empty(); }
  int first_sheet(std::uint32_t number) const {
    const std::int32_t depth = projected.splats[number].depth;
    if (!sliced()) return depth;
    return shaped() ? slices.first(depth, growth(number)) : slices.first(depth);
  }
  /// Whether the splat's kernel is stretched in depth; if so, its shares are those of the stretched kernel.
  bool grown(std::uint32_t number) const {
    return sliced() && shaped() && projected.ellipses[number].shrink != DepthGrowth{}.shrink;
  }
  /// The part of a splat in a sheet, in a frame with ellipses.
  Share share(std::uint32_t number, int sheet) const {
    const QuantisedSplat& splat = projected.splats[number];
    return sliced() && shaped() ? slices.share(splat.words, splat.depth, sheet, growth(number))
                                : share(splat.words, splat.depth, sheet);
  }
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
  /// Emits one sheet of one tile; nothing if it is empty. Returns the number of records.
  std::uint32_t emit_sheet(int tile, int sheet, std::uint32_t& tag, cmodel::RecordSink& out, TileReport& report) const;
  /// The same if the tile's splats are in cull groups; returns true if the sheet was written.
  bool emit_sets(int tile, int sheet, std::uint32_t& tag, cmodel::RecordSink& out, TileReport& report) const;
  /// Whether splats are in cull groups. Ellipses never are: each is tested individually.
  bool in_sets() const { return config.culls() && cmodel::culls_in(mode) && !shaped(); }
  /// The cull groups of a tile's sheet, after `written` earlier sheets of the tile, and the ungrouped cells.
  SheetSets sheet_sets(int tile, int sheet, std::uint64_t written) const;
  /// visit(EllipseRecord), with tag 0, for every record of a splat with kOwnShape that meets the tile; there may be
  /// none.
  template <class Visit>
  void for_each_ellipse(int tile, std::uint32_t number, const SplatWords& colour, Visit visit) const {
    const QuantisedSplat& splat = projected.splats[number];
    const cmodel::EllipseShape& shape = projected.ellipses[number].shape;
    const int pf = config.position_frac_bits;
    const std::int32_t x = (splat.x >> pf) - grid.x(tile), y = (splat.y >> pf) - grid.y(tile);
    for (const EllipseSpan& span : EllipseSpans(config, shape, splat.x, splat.y)) {
      if (x + span.right <= -halo() || x + span.windows.left >= grid.width(tile) + halo() ||
          y + span.bottom <= -halo() || y + span.windows.top >= grid.height(tile) + halo())
        continue;
      visit(cmodel::EllipseRecord{.tag = 0,
                                  .x = splat.x - grid.x(tile) * (1 << pf),
                                  .y = splat.y - grid.y(tile) * (1 << pf),
                                  .colour = colour,
                                  .shape = shape,
                                  .windows = span.windows});
    }
  }

 private:
  Cells make_cells() const;
  TileBins make_bins(int threads) const;
};

}  // namespace fastsplat::driver
