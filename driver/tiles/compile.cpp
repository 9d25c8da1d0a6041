// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/compile.hpp"

#include <algorithm>
#include <array>

#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tiles/beat_writer.hpp"
#include "driver/tiles/compiled_state.hpp"

namespace fastsplat::driver {

CompiledFrame::State::State(const scene::Scene& scene, FrameHead head, int threads, int band_rows)
    : FrameHead(std::move(head)),
      projected(project(scene, SplatQuantiser(scene, config, sets, slices, plan, pictures()), threads)),
      bands(grid, band_rows > 0 && !config.culls() && !holds_densities(scene.description)
                      ? (band_rows + config.lanes - 1) / config.lanes * config.lanes
                      : config.tile_height),
      windows(config, sets),
      cells(make_cells()),
      bins(make_bins(threads)) {
  if (sliced()) reach = shaped() ? slices.reach(slices.growth(projected.least_shrink)) : slices.reach();
}

Cells CompiledFrame::State::make_cells() const {
  return in_sets() ? Cells(grid, cmodel::cull_cell_pixels(config)) : Cells();
}

TileBins CompiledFrame::State::make_bins(int threads) const {
  const auto& splats = projected.splats;
  return TileBins(
      grid, bands, cells, plan.slabs.count, splats.size(), threads,
      [&](std::size_t i) {
        return widened(
            splats[i].set == kOwnShape ? windows(splats[i], projected.ellipses[i].shape) : windows(splats[i]), halo());
      },
      [&](std::size_t i) { return first_sheet(static_cast<std::uint32_t>(i)); });
}

std::uint32_t CompiledFrame::State::emit_sheet(int tile, int sheet, std::uint32_t& tag, cmodel::RecordSink& out,
                                               TileReport& report) const {
  const std::int32_t x0 = grid.x(tile) * (1 << config.position_frac_bits),
                     y0 = grid.y(tile) * (1 << config.position_frac_bits);
  std::array<cmodel::SplatRecord, 256> some;
  std::size_t waiting = 0;
  std::uint32_t records = 0;
  std::vector<std::uint32_t> merged;
  for (int from = std::max(0, sheet - reach); from <= sheet; ++from) {
    for (const std::uint32_t number : bins.bin(tile, from, merged)) {
      const QuantisedSplat& splat = projected.splats[number];
      const Share part = share(number, sheet);
      if (part.empty()) continue;
      if (splat.set == kOwnShape) {
        if (waiting > 0) out.splats(std::span(some).first(waiting));
        waiting = 0;
        std::uint32_t more = 0;
        for_each_ellipse(tile, number, part.words, [&](cmodel::EllipseRecord record) {
          if (records + more++ == 0) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
          record.tag = tag++;
          out.ellipses({&record, 1});
        });
        report.saturated_records += part.saturated ? more : 0;
        records += more;
        continue;
      }
      if (records == 0) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
      report.saturated_records += part.saturated ? 1 : 0;
      some[waiting++] = {.set = splat.set, .tag = tag++, .x = splat.x - x0, .y = splat.y - y0, .colour = part.words};
      ++records;
      if (waiting < some.size()) continue;
      out.splats(some);
      waiting = 0;
    }
  }
  if (waiting > 0) out.splats(std::span(some).first(waiting));
  if (records > 0) out.end_sheet({static_cast<std::uint32_t>(sheet), records});
  return records;
}

CompiledFrame::CompiledFrame(const scene::Scene& scene, const cmodel::Config& config, int threads, int band_rows)
    : CompiledFrame(scene, FrameHead(scene, config, threads), threads, band_rows) {}
CompiledFrame::CompiledFrame(const scene::Scene& scene, FrameHead head, int threads, int band_rows)
    : state_(std::make_unique<const State>(scene, std::move(head), threads, band_rows)) {}
CompiledFrame::~CompiledFrame() = default;

const cmodel::Config& CompiledFrame::config() const { return state_->config; }
const TileGrid& CompiledFrame::grid() const { return state_->grid; }
int CompiledFrame::bands() const { return state_->bands.of_tile(); }
std::span<const cmodel::Beat> CompiledFrame::preamble() const { return state_->preamble; }

TileReport CompiledFrame::emit_tile(int tile, cmodel::RecordSink& sink) const {
  const State& s = *state_;
  sink.begin_tile(s.begin_tile(tile));
  TileReport report;
  std::uint32_t tag = 0;
  for (int sheet = 0; sheet < s.plan.slabs.count; ++sheet) {
    if (s.in_sets()) {
      report.sheets += s.emit_sets(tile, sheet, tag, sink, report) ? 1 : 0;
      continue;
    }
    const std::uint32_t records = s.emit_sheet(tile, sheet, tag, sink, report);
    report.sheets += records > 0 ? 1 : 0;
    report.splat_records += records;
  }
  sink.end_tile({static_cast<std::uint32_t>(tile), static_cast<std::uint32_t>(report.sheets)});
  return report;
}

TileReport CompiledFrame::emit_tile(int tile, const cmodel::BeatSink& sink, const Hides& hides) const {
  BeatWriter beats(sink, hides);
  return emit_tile(tile, beats);
}

DriverReport CompiledFrame::emit(const cmodel::BeatSink& sink, const Progress& progress) const {
  DriverReport out = report();
  sink(preamble());
  for (int tile = 0; tile < grid().count(); ++tile) {
    out += emit_tile(tile, sink);
    if (progress) progress(static_cast<std::size_t>(tile) + 1, out.tiles);
  }
  return out;
}

std::vector<std::uint64_t> CompiledFrame::work() const {
  std::vector<std::uint64_t> out;
  for (int tile = 0; tile < grid().count(); ++tile) {
    for (int band = 0; band < bands(); ++band) out.push_back(state_->bins.count(tile, band));
  }
  return out;
}

DriverReport& operator+=(DriverReport& report, const TileReport& tile) {
  report.splat_records += tile.splat_records;
  report.saturated_records += tile.saturated_records;
  report.sheets += tile.sheets;
  return report;
}

DriverReport CompiledFrame::report() const {
  return {.voxels = state_->projected.voxels,
          .tiles = static_cast<std::uint64_t>(state_->grid.count()),
          .saturated_voxels = state_->projected.saturated,
          .vanished_voxels = state_->projected.vanished,
          .vanished_share = state_->projected.vanished_share,
          .widened_voxels = state_->projected.widened,
          .carried = state_->projected.carried};
}

}  // namespace fastsplat::driver
